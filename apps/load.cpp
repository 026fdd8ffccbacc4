// SPDX-License-Identifier: BSD-3-Clause
#include "load.h"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>

#include "flbc/errors.h"
#include "flbc/io/files.h"
#include "flbc/meshing.h"
#ifdef FLBC_WITH_OPENMESH
#include "openmesh_bindings/mesh_io.h"
#endif

namespace flbc::app {
namespace {

template <int Dim>
void check_cage(const Cage<Dim>& cage, const std::string& path) {
  auto defects = find_defects(cage, 1);
#ifdef FLBC_WITH_CGAL
  if (defects.empty()) defects = find_self_intersections(cage, 1);
#endif
  if (!defects.empty()) throw InputError(path + ": " + defects.front().message);
}

}  // namespace

io::PolygonSoup load_polygons(const std::string& path) {
  const auto extension = io::extension_of(path);
  if (extension == "obj" || path == "-") return io::read_obj(path);
  if (extension == "off") return io::read_off(path);
#ifdef FLBC_WITH_OPENMESH
  if (extension == "ply" || extension == "stl" || extension == "om") {
    return openmesh::read_polygons(path);
  }
  throw OptionError(path + ": expected a file ending in .obj, .off, .ply, .stl or .om");
#else
  throw OptionError(path + ": expected a file ending in .obj or .off");
#endif
}

io::AnyCage load_cage(const std::string& path) {
  auto cage = io::to_cage(load_polygons(path), path);
  std::visit([&](const auto& any) { check_cage(any, path); }, cage);
  return cage;
}

template <int Dim>
PointList<Dim> load_model(const std::string& path) {
  auto points = io::to_points<Dim>(load_polygons(path), path);
  if (points.cols() == 0) throw InputError(path + ": the model has no vertices");
  return points;
}

void require_writable(const std::string& path, std::initializer_list<const char*> extensions) {
  if (path.empty()) return;
  if (std::find(extensions.begin(), extensions.end(), io::extension_of(path)) == extensions.end()) {
    std::string list;
    for (const auto* extension : extensions)
      list += std::string(list.empty() ? "." : ", .") + extension;
    throw OptionError(path + ": cannot tell the format; the file must end in " + list);
  }
  auto folder = std::filesystem::path(path).parent_path();
  if (folder.empty()) folder = ".";
  if (access(folder.c_str(), W_OK) != 0) {
    throw IoError(path + ": cannot write in folder " + folder.string() + ": " +
                  std::strerror(errno));
  }
}

template PointList<2> load_model(const std::string&);
template PointList<3> load_model(const std::string&);

}  // namespace flbc::app
