// SPDX-License-Identifier: BSD-3-Clause
// Models and cages.
#include <sstream>
#include <string>
#include <variant>

#include "flbc/cage.h"
#include "flbc/errors.h"
#include "flbc/io/cage_io.h"
#include "flbc/io/files.h"
#include "flbc/io/model_file.h"
#include "fuzz/reader.h"
#include "model/svg_document.h"

namespace flbc::fuzz {
namespace {

bool in_range(Index index, Eigen::Index count) {
  return index >= 0 && index < count;
}

bool in_range_or_none(Index index, Eigen::Index count) {
  return index == -1 || in_range(index, count);
}

void require_soup(const io::PolygonSoup& soup) {
  const auto count = static_cast<Eigen::Index>(soup.points.size());
  for (const auto& point : soup.points) require(point.allFinite(), "points are finite");
  for (const auto& lists : {soup.polygons, soup.polylines}) {
    for (const auto& list : lists) {
      for (const Index vertex : list) require(in_range(vertex, count), "vertices are in range");
    }
  }
  for (const auto& polygon : soup.polygons) require(polygon.size() > 2, "polygons have corners");
}

void require_attributes(const io::Model& model) {
  const auto& attributes = model.attributes;
  require(attributes.texture_coordinates.allFinite(), "texture coordinates are finite");
  require(attributes.normals.allFinite(), "normals are finite");
  const auto& colors = attributes.colors;
  const auto points = static_cast<Eigen::Index>(model.soup.points.size());
  require(colors.cols() == 0 || colors.cols() == points, "colours are of all vertices");
  require((colors.array() >= 0 && colors.array() <= 1).all(), "colours are between 0 and 1");
  const auto& corners = attributes.corners;
  require(corners.empty() || corners.size() == model.soup.polygons.size(), "corners by polygon");
  for (std::size_t f = 0; f < corners.size(); ++f) {
    require(corners[f].size() == model.soup.polygons[f].size(), "a reference per corner");
    for (const auto& corner : corners[f]) {
      require(in_range_or_none(corner.texture_coordinate, attributes.texture_coordinates.cols()) &&
                  in_range_or_none(corner.normal, attributes.normals.cols()),
              "corners' references are in range");
    }
  }
  const auto& materials = model.polygon_materials;
  require(materials.empty() || materials.size() == model.soup.polygons.size(), "materials");
  for (const Index material : materials) {
    require(in_range_or_none(material, static_cast<Eigen::Index>(model.materials.size())),
            "materials are in range");
  }
  for (const auto& material : model.materials) {
    require((material.color.array() >= 0 && material.color.array() <= 1).all() &&
                material.opacity >= 0 && material.opacity <= 1 && material.roughness >= 0 &&
                material.roughness <= 1 && material.metallic >= 0 && material.metallic <= 1,
            "a look is made of numbers between 0 and 1");
  }
}

PointList<3> points_of(const io::PolygonSoup& soup) {
  PointList<3> points(3, static_cast<Eigen::Index>(soup.points.size()));
  for (Eigen::Index v = 0; v < points.cols(); ++v) points.col(v) = soup.points[v];
  return points;
}

// A file whose vertices stay is written byte by byte as it was.
void require_faithful_writing(const io::ModelFile& file) {
  std::ostringstream out;
  file.write<3>(out, points_of(file.model().soup));
  require(out.str() == file.text(), "vertices that stay leave the file as it was");
}

// Documents can be edited, or say why not.
void require_edit(const io::ModelFile& file) {
  std::ostringstream out;
  const PointList<3> points = points_of(file.model().soup).array() + 0.5;
  try {
    file.write<3>(out, points);
  } catch (const Error&) {
    return;
  }
  require(out.str() != file.text(), "vertices have moved");
}

void require_cage(const io::PolygonSoup& soup) {
  const auto check = [](const auto& cage) {
    for (const auto& facet : cage.facets.colwise()) {
      for (const Index vertex : facet) require(in_range(vertex, cage.size()), "facets in range");
    }
    find_defects(cage);
  };
  std::visit(check, io::to_cage(soup, "cage"));
}

void read_model(const std::string& path) {
  const io::ModelFile file(path);
  require_soup(file.model().soup);
  require_attributes(file.model());
  require_faithful_writing(file);
  if (file.model().gltf) require_edit(file);
  const auto soup = io::read_polygons(path);
  require(soup.points == file.model().soup.points && soup.polygons == file.model().soup.polygons,
          "cages are what models are");
  require_cage(soup);
}

// The file that is fuzzed is the one of the materials.
void read_materials(const std::string& path) {
  const auto model = path.substr(0, path.size() - 3) + "obj";
  require_attributes(io::ModelFile(model).model());
}

// A drawing that is read and moved.
void read_drawing(const std::string& path) {
  const io::SvgDocument drawing(io::read_file(path), path, {9, 9}, Eigen::Affine2d::Identity());
  const PointList<2> points = drawing.points();
  require(points.allFinite() && points.cols() > 0, "points of a drawing are finite");
  for (const Index p : {Index(0), static_cast<Index>(points.cols()) - 1}) drawing.element_of(p);
  drawing.moved(2 * points);
}

// A tent over a square, with all that models may have.
io::Model tent() {
  io::Model model;
  model.soup.points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0.25}, {0, 1, -1e-3}, {0.5, 0.5, 1.0 / 3}};
  model.soup.polygons = {{3, 2, 1, 0}, {0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}};
  auto& attributes = model.attributes;
  attributes.normals = PointList<3>::Constant(3, 5, 0.5);
  attributes.texture_coordinates = PointList<2>::Constant(2, 5, 0.25);
  attributes.colors = PointList<3>::Constant(3, 5, 0.2);
  for (const auto& polygon : model.soup.polygons) {
    auto& corners = attributes.corners.emplace_back();
    for (const Index vertex : polygon) corners.push_back({vertex, vertex});
  }
  return model;
}

std::string tent_as(const std::string& name, bool is_text) {
  auto model = tent();
  model.is_text = is_text;
  return written(name, [&](const std::string& path) { io::write_model(path, model); });
}

const char* const kObjWithMaterials =
    "mtllib input.mtl\no tent\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvn 0 0 1\ng a\n"
    "usemtl red paint\nf 1/1/1 2/1/1 3/1/1\nusemtl other\ns off\nf -4//1 -2//1 \\\n -1//1\n";

const char* const kObjPolylines =
    "# two loops\nv 0 0\nv 4 0\nv 4 4\nv 0 4\nv 1 1 0\nv 1 2 0\nv 2 2 0\nl 1 2 3 4 1\nl 5 6 7 5\n";

const char* const kMaterials =
    "newmtl red paint\nKd 0.8 0.1 0.1\nd 0.5\nNs 250\nPr 0.3\nPm 1\nmap_Kd -s 1 1 1 -clamp on a "
    "b.png\n"
    "newmtl other\nKd 0.5\nTr 0.25\n";

const char* const kPlyOfScanner =
    "ply\nformat ascii 1.0\ncomment TextureFile a.png\nelement vertex 4\nproperty double x\n"
    "property float y\nproperty float z\nproperty uchar red\nproperty uchar green\n"
    "property uchar blue\nelement face 2\nproperty list uchar int vertex_indices\n"
    "property list uchar float texcoord\nelement edge 1\nproperty int a\nend_header\n"
    "0 0 0 1 2 3\n1 0 0 255 0 0\n0 1 0 9 9 9\n0 0 1 0 0 0\n3 0 1 2 6 0 0 1 0 0 1\n"
    "3 0 2 3 6 0 0 1 0 0 1\n7\n";

const char* const kDrawing =
    "<svg viewBox='0 0 9 9'><defs><linearGradient id='g' gradientUnits='userSpaceOnUse'/><clipPath "
    "id='c'><rect width='50%' height='2mm' rx='1'/></clipPath></defs><g transform='matrix(1 2 3 4 "
    "5 "
    "6) rotate(7)' fill='url(#g)'><path id='p' clip-path='url(#c)' d='M1 1a2 3 4 1 0 5 "
    "6q1-2.5.5t7,8s"
    "1 2 3 4z'/><use href='#p' x='1'/><text x='1' font-size='3'>a</text><svg x='1' "
    "viewBox='0 0 1 2' preserveAspectRatio='xMinYMax slice'><polygon points='1,2 3,4 5 6'/><image "
    "width='1' height='1'/></svg></g></svg>";

const char* const kSu2 =
    "% a\nNDIME= 3\nNELEM=2\n10 0 1 2 3 0\n5 1 3 4 2\nNPOIN= 5 5\n0 0 0 0\n1 0 0.5 1\n0.5 1 2 2\n"
    "2 0 3 3\n2 1 4 4\nNMARK= 1\nMARKER_TAG= wall\nMARKER_ELEMS= 2\n3 0 1\n9 0 1 2 3\n";

const char* const kStlText =
    "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\n"
    "endfacet\nfacet normal 0 0 -1\nouter loop\nvertex 0 0 0\nvertex 0 1 0\nvertex 1 0 0\nendloop\n"
    "endfacet\nendsolid a\n";

const char* const kOffWithAll =
    "STCNOFF\n# all attributes\n3 1 0\n0 0 0 0 0 1 0.5 0.5 0.5 1 0 0\n"
    "1 0 0 0 0 1 0.5 0.5 0.5 1 1 0\n0 1 0 0 0 1 1 0 0 1 0 1\n3 0 1 2 255 0 0\n";

}  // namespace

std::vector<Reader> model_readers() {
  return {
      {"obj",
       "input.obj",
       read_model,
       {tent_as("a.obj", true), kObjWithMaterials, kObjPolylines},
       {{"input.mtl", kMaterials}}},
      {"mtl", "input.mtl", read_materials, {kMaterials}, {{"input.obj", kObjWithMaterials}}, false},
      {"off", "input.off", read_model, {tent_as("a.off", true), kOffWithAll}},
      {"ply",
       "input.ply",
       read_model,
       {tent_as("a.ply", true), tent_as("a.ply", false), kPlyOfScanner}},
      {"glb", "input.glb", read_model, {tent_as("a.glb", false)}},
      {"svg", "input.svg", read_drawing, {kDrawing}},
      {"su2", "input.su2", read_model, {kSu2}},
      {"stl",
       "input.stl",
       read_model,
       {kStlText, tent_as("a.stl", true), tent_as("a.stl", false)}}};
}

}  // namespace flbc::fuzz
