// SPDX-License-Identifier: BSD-3-Clause
#include "files/load_surface.h"

#include <algorithm>

#include "files/load.h"
#include "flbc/io/files.h"
#include "flbc/io/mesh_io.h"

namespace flbc::app {
namespace {

using Extensions = std::initializer_list<const char*>;
constexpr Extensions kPolygons = {"obj", "off", "ply", "stl"};
constexpr Extensions kMeshes = {"vtu", "mesh", "node", "ele", "msh"};

bool is_one_of(const std::string& extension, Extensions extensions) {
  return std::find(extensions.begin(), extensions.end(), extension) != extensions.end();
}

}  // namespace

void require_surface_readable(const std::string& path) {
  const auto extension = io::extension_of(path);
  if (is_one_of(extension, kPolygons) || is_one_of(extension, kMeshes)) return;
  throw OptionError(path +
                    ": cannot tell the format; a model must end in .obj, .off, .ply or .stl, a "
                    "domain mesh in .vtu, .mesh, .node, .ele or .msh");
}

template <int Dim>
SurfaceModel<Dim> load_surface(const std::string& path) {
  const auto extension = io::extension_of(path);
  if (is_one_of(extension, kMeshes)) {
    if (Dim == 2 && extension != "vtu") {
      throw OptionError(path + ": holds tetrahedra, but the cage is in 2D");
    }
    const auto mesh = io::read_domain<Dim>(path);
    return {mesh.points, naming(path, [&] { return gltf::surface_of_domain(mesh); })};
  }
  const auto soup = load_polygons(path);
  const auto points = io::to_points<Dim>(soup, path);
  const auto attributes =
      extension == "obj" ? io::read_obj_attributes(path, soup) : io::SurfaceAttributes();
  return {points, naming(path, [&] { return gltf::surface_of_polygons<Dim>(soup, attributes); })};
}

template SurfaceModel<2> load_surface(const std::string&);
template SurfaceModel<3> load_surface(const std::string&);

}  // namespace flbc::app
