// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/openmesh/om_file.h"

#include <OpenMesh/Core/IO/MeshIO.hh>
#include <OpenMesh/Core/Mesh/PolyMesh_ArrayKernelT.hh>
#include <algorithm>
#include <cmath>

#include "flbc/errors.h"
#include "flbc/io/files.h"
#include "flbc/openmesh/silenced.h"

namespace flbc::openmesh {
namespace {

using OpenMesh::IO::Options;

struct OmTraits : OpenMesh::DefaultTraits {
  using Point = OpenMesh::Vec3d;
  using Normal = OpenMesh::Vec3d;
};
using OmMesh = OpenMesh::PolyMesh_ArrayKernelT<OmTraits>;

template <class Point>
OpenMesh::Vec3d to_vec3d(const Point& point) {
  return {point[0], point[1], point[2]};
}

unsigned char level_of(double intensity) {
  return static_cast<unsigned char>(std::lround(255 * std::clamp(intensity, 0.0, 1.0)));
}

void add_polygons(OmMesh& mesh, const io::PolygonSoup& soup) {
  for (const auto& point : soup.points) mesh.add_vertex(to_vec3d(point));
  for (std::size_t f = 0; f < soup.polygons.size(); ++f) {
    std::vector<OpenMesh::VertexHandle> corners;
    for (const Index vertex : soup.polygons[f]) corners.emplace_back(vertex);
    auto sorted = corners;
    std::sort(sorted.begin(), sorted.end());
    const bool is_simple = std::adjacent_find(sorted.begin(), sorted.end()) == sorted.end();
    if (is_simple && mesh.add_face(corners).is_valid()) continue;
    throw InputError("polygon " + std::to_string(f) +
                     " does not fit into a half-edge mesh, which .om files hold: " +
                     (is_simple ? "another one is already on the same side of one of its edges, or "
                                  "its neighbors do not form a surface there"
                                : "it has a vertex twice"));
  }
}

// \return the options to write the added attributes
Options add_attributes(OmMesh& mesh, const io::Model& model) {
  Options options(Options::Binary);
  const auto normals = io::normals_at_vertices(model).value_or(PointList<3>());
  const auto texture = io::texture_coordinates_at_vertices(model).value_or(PointList<2>());
  const auto& colors = model.attributes.colors;
  if (normals.cols() > 0) {
    mesh.request_vertex_normals();
    options += Options::VertexNormal;
    for (const auto v : mesh.vertices()) mesh.set_normal(v, to_vec3d(normals.col(v.idx())));
  }
  if (texture.cols() > 0) {
    mesh.request_vertex_texcoords2D();
    options += Options::VertexTexCoord;
    for (const auto v : mesh.vertices()) {
      const auto t = texture.col(v.idx());
      mesh.set_texcoord2D(v, {static_cast<float>(t[0]), static_cast<float>(t[1])});
    }
  }
  if (colors.cols() > 0) {
    mesh.request_vertex_colors();
    options += Options::VertexColor;
    for (const auto v : mesh.vertices()) {
      const auto c = colors.col(v.idx());
      mesh.set_color(v, {level_of(c[0]), level_of(c[1]), level_of(c[2])});
    }
  }
  return options;
}

}  // namespace

void write_om(const std::string& path, const io::Model& model) {
  const SilencedOpenMesh silence;
  OmMesh mesh;
  add_polygons(mesh, model.soup);
  const auto options = add_attributes(mesh, model);
  io::write_file(path, [&](std::ostream& out) {
    if (!OpenMesh::IO::write_mesh(mesh, out, ".om", options)) {
      throw IoError("OpenMesh cannot write \"" + path + "\"");
    }
  });
}

}  // namespace flbc::openmesh
