// SPDX-License-Identifier: BSD-3-Clause
#include "files/load.h"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>

#include "flbc/errors.h"
#include "flbc/io/files.h"
#include "flbc/io/model_file.h"
#include "flbc/meshing.h"
#include "flbc/self_intersections.h"
#ifdef FLBC_WITH_OPENMESH
#include "flbc/openmesh/mesh_io.h"
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

bool is_same_file(const std::string& a, const std::string& b) {
  namespace fs = std::filesystem;
  if (a.empty() || b.empty() || a == "-" || b == "-") return false;
  std::error_code error;
  if (fs::exists(a, error) && !fs::is_regular_file(a, error)) return false;  // as /dev/null
  if (fs::equivalent(a, b, error)) return true;
  return fs::weakly_canonical(a, error) == fs::weakly_canonical(b, error);
}

}  // namespace

io::PolygonSoup load_polygons(const std::string& path) {
  const auto extension = io::extension_of(path);
  if (extension == "obj" || path == "-") return io::read_obj(path);
  if (extension == "off") return io::read_off(path);
#ifdef FLBC_WITH_OPENMESH
  if (extension == "stl") return openmesh::read_polygons(path);
#endif
  if (extension == "ply" || extension == "om") return io::ModelFile(path).model().soup;
#ifdef FLBC_WITH_OPENMESH
  throw OptionError(path + ": expected a file ending in .obj, .off, .ply, .stl or .om");
#else
  throw OptionError(path + ": expected a file ending in .obj, .off, .ply or .om");
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

void require_distinct(const std::vector<std::string>& inputs,
                      const std::vector<std::string>& outputs) {
  for (std::size_t k = 0; k < outputs.size(); ++k) {
    for (const auto& input : inputs) {
      if (is_same_file(outputs[k], input)) {
        throw OptionError(outputs[k] + ": the result would replace this file, which is read");
      }
    }
    for (std::size_t l = 0; l < k; ++l) {
      if (is_same_file(outputs[k], outputs[l])) {
        throw OptionError(outputs[k] + ": two results would go to this one file");
      }
    }
  }
}

template PointList<2> load_model(const std::string&);
template PointList<3> load_model(const std::string&);

}  // namespace flbc::app
