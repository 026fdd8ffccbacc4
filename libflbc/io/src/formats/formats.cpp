// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/io/formats.h"

#include <algorithm>
#include <string_view>
#include <utility>

#include "flbc/errors.h"
#include "flbc/io/files.h"
#include "formats/format_table.h"
#include "mesh/mesh_formats.h"
#include "weights/weights_formats.h"

namespace flbc::io {
namespace {

// Triangles in the plane are polygons.
constexpr MeshFormat<2> kTriangles{read_triangles, write_triangles};
template <int Dim>
constexpr MeshFormat<Dim> kVtu{read_vtu<Dim>, write_vtu<Dim>, true};

constexpr Format kFormats[] = {
    {"obj", {read_obj, write_obj, Attributes::kCorners}, kTriangles},
    {"off", {read_off, write_off, Attributes::kVertices}, kTriangles},
    {"ply", {read_ply, write_ply, Attributes::kVertices}},
    {"stl", {read_stl, write_stl}},
    {"glb", {read_gltf, write_glb, Attributes::kCorners}},
    {"gltf", {read_gltf, nullptr, Attributes::kCorners}},
    {"vrm", {read_gltf, nullptr, Attributes::kCorners}},  // .glb of persons
    {"su2", {read_su2}},
    {"svg", {read_svg}},
    {"vtu", {}, kVtu<2>, kVtu<3>},
    {"mesh", {}, {}, {read_medit, write_medit}},
    {"msh", {}, {}, {read_gmsh, write_gmsh}},
    {"mtx", {}, {}, {}, {read_mtx, write_mtx}},
    {"npy", {}, {}, {}, {read_npy, write_npy}},
    {"csv", {}, {}, {}, {read_csv, write_csv}},
    {"npz", {}, {}, {}, {read_npz, write_npz}},
};

bool has(const Format& format, Content content) {
  switch (content) {
    case Content::kModel:
      return format.model.read;
    case Content::kMesh2D:
      return format.mesh_2d.read;
    case Content::kMesh3D:
      return format.mesh_3d.read;
    case Content::kWeights:
      return format.weights.read;
    case Content::kColors:
      return format.model.attributes != Attributes::kNone;
    case Content::kFields:
      return format.mesh_2d.keeps_fields || format.mesh_3d.keeps_fields;
  }
  return false;
}

bool has_one(const Format& format, std::initializer_list<Content> contents) {
  return std::any_of(contents.begin(), contents.end(),
                     [&](Content content) { return has(format, content); });
}

const Format* find(const std::string& path) {
  const auto extension = extension_of(path);
  const auto* const found =
      std::find_if(std::begin(kFormats), std::end(kFormats),
                   [&](const Format& format) { return format.extension == extension; });
  return found == std::end(kFormats) ? nullptr : found;
}

}  // namespace

bool holds(const std::string& path, std::initializer_list<Content> contents) {
  const auto* const format = find(path);
  return format && has_one(*format, contents);
}

std::string extensions_of(std::initializer_list<Content> contents) {
  std::vector<std::string> names;
  for (const auto& format : kFormats) {
    if (has_one(format, contents)) names.push_back("." + std::string(format.extension));
  }
  std::string list = names.front();
  for (std::size_t k = 1; k < names.size(); ++k) {
    list += (k + 1 < names.size() ? ", " : " or ") + names[k];
  }
  return list;
}

std::string conversion_hint(const std::string& path) {
  // Extensions between blanks, and what to do.
  constexpr std::pair<std::string_view, const char*> kOthers[] = {
      {" fbx blend dae 3ds abc usd usda usdc usdz x3d wrl max ",
       "convert it to .obj or .ply first, for example in Blender"},
      {" dxf ", "save the drawing as .svg first, for example in Inkscape"},
      {" node ele ", "convert it to .mesh first: tetgen -g writes it, and meshio converts it"},
      {" om ",
       "save it as .ply with OpenMesh::IO, or deform the mesh with flbc/openmesh/bind.h, which "
       "keeps "
       "its properties"},
      {" dmat ",
       "write .csv from libigl: out << W.format(Eigen::IOFormat(Eigen::FullPrecision, "
       "Eigen::DontAlignCols, \",\"))"},
      {" spz splat ksplat sog ",
       "export it as an uncompressed .ply first, for example in SuperSplat"},
      {" gz bz2 xz zst zip 7z ", "unpack it first"}};
  const auto extension = " " + extension_of(path) + " ";
  for (const auto& [extensions, way_out] : kOthers) {
    if (extension.size() > 2 && extensions.find(extension) != std::string_view::npos) {
      return std::string("; ") + way_out;
    }
  }
  return {};
}

const Format& format_of(const std::string& path, Content content, const char* action) {
  if (holds(path, {content})) return *find(path);
  throw OptionError("cannot " + std::string(action) + " \"" + path +
                    (find(path) ? "\": the format is for other data" : "\": unknown file format") +
                    "; the file must end in " + extensions_of({content}) +
                    (std::string(action).find("read") == 0 ? conversion_hint(path) : ""));
}

}  // namespace flbc::io
