// SPDX-License-Identifier: BSD-3-Clause
#include "front/load.h"

#include <algorithm>
#include <filesystem>
#include <set>

#include "flbc/errors.h"
#include "flbc/io/files.h"
#include "flbc/io/model_file.h"
#include "flbc/io/weights_io.h"
#include "flbc/meshing.h"
#include "front/system/held_signals.h"
#include "front/system/system.h"

namespace flbc::app {
namespace {

constexpr const char* kRepair = "; try flbc cage --repair";

// Not what is wrong with the cage as a whole, or with its numbers.
template <int Dim>
bool is_mendable(const Cage<Dim>& cage, const Defect& defect) {
  return cage.points.allFinite() && !(defect.vertices.empty() && defect.facets.empty());
}

template <int Dim>
void check_cage(const Cage<Dim>& cage, const io::PolygonSoup& soup, const std::string& path) {
  auto defects = defects_of(cage, 1);
  if (!defects.empty()) {
    if (Dim == 3) name_faces(defects, soup);
    const char* const advice = is_mendable(cage, defects.front()) ? kRepair : "";
    throw InputError(path + ": " + defects.front().message + advice);
  }
}

bool is_same_file(const std::string& a, const std::string& b) {
  namespace fs = std::filesystem;
  if (a.empty() || b.empty() || a == "-" || b == "-") return false;
  std::error_code error;
  if (fs::exists(a, error) && !fs::is_regular_file(a, error)) return false;  // as /dev/null
  if (fs::equivalent(a, b, error)) return true;
  return fs::weakly_canonical(a, error) == fs::weakly_canonical(b, error);
}

[[noreturn]] void fail_extension(const std::string& path, const std::string& extensions) {
  const bool is_fbx = io::extension_of(path) == "fbx";
  throw OptionError(path + ": unknown file format; the file must end in " + extensions +
                    (is_fbx ? "; programs that read FBX usually read glTF (.glb) as well" : ""));
}

}  // namespace

template <int Dim>
std::vector<Defect> defects_of(const Cage<Dim>& cage, std::size_t most) {
  auto defects = find_defects(cage, most);
#ifdef FLBC_LINKS_CGAL
  if (defects.empty()) defects = find_self_intersections(cage, most);
#endif
  return defects;
}

io::AnyCage load_cage(const std::string& path) {
  return checked_cage(io::read_polygons(path), path);
}

io::AnyCage checked_cage(const io::PolygonSoup& soup, const std::string& path) {
  auto cage = [&] {
    try {
      return io::to_cage(soup, path);
    } catch (const InputError& error) {
      const bool is_mixed = !soup.polygons.empty() && !soup.polylines.empty();
      throw InputError(error.what() + std::string(is_mixed ? kRepair : ""));
    }
  }();
  std::visit([&](const auto& any) { check_cage(any, soup, path); }, cage);
  return cage;
}

void name_faces(std::vector<Defect>& defects, const io::PolygonSoup& soup) {
  std::vector<Index> face_of_triangle;
  for (std::size_t face = 0; face < soup.polygons.size(); ++face) {
    const auto count = soup.polygons[face].size();
    face_of_triangle.insert(face_of_triangle.end(), count > 2 ? count - 2 : 0, Index(face));
  }
  if (face_of_triangle.size() == soup.polygons.size()) return;  // all are triangles
  for (auto& defect : defects) {
    std::set<Index> faces;
    for (const Index triangle : defect.facets) faces.insert(face_of_triangle[triangle]);
    if (faces.empty()) continue;
    std::string text;
    std::size_t left = faces.size();
    for (const Index face : faces) {
      text += std::to_string(face) + (left > 2 ? ", " : left == 2 ? " and " : "");
      --left;
    }
    defect.message += (faces.size() > 1 ? " (faces " : " (face ") + text + " of the file)";
  }
}

bool is_point_file(const std::string& path) {
  const auto extension = io::extension_of(path);
  return extension == "npy" || extension == "csv";
}

template <int Dim>
PointList<Dim> load_points(const std::string& path) {
  const WeightMatrix numbers = io::read_weights(path).dense();  // a row per point, as for weights
  if (numbers.rows() != Dim || numbers.cols() == 0) {
    throw InputError(path + ": holds " + std::to_string(numbers.cols()) + " rows of " +
                     std::to_string(numbers.rows()) + " numbers; points need " +
                     std::to_string(Dim) + " coordinates");
  }
  return numbers;
}

template <int Dim>
PointList<Dim> load_model(const std::string& path) {
  if (is_point_file(path)) return load_points<Dim>(path);
  auto points = io::to_points<Dim>(io::read_polygons(path), path);
  if (points.cols() == 0) throw InputError(path + ": the model has no vertices");
  return points;
}

void require_writable_folder(const std::string& path) {
  if (path.empty()) return;
  auto folder = std::filesystem::path(path).parent_path();
  if (folder.empty()) folder = ".";
  const auto reason = why_not_writable(folder.string());
  if (!reason.empty()) {
    throw IoError(path + ": cannot write in folder " + folder.string() + ": " + reason);
  }
}

void require_writable(const std::string& path, const char* extension) {
  require_writable(path, std::vector<std::string>{extension});
}

void require_writable(const std::string& path, const std::vector<std::string>& extensions) {
  if (path.empty()) return;
  const auto found = std::find(extensions.begin(), extensions.end(), io::extension_of(path));
  if (found == extensions.end()) {
    std::string names = '.' + extensions.front();
    for (std::size_t k = 1; k < extensions.size(); ++k) {
      names += (k + 1 < extensions.size() ? ", ." : " or .") + extensions[k];
    }
    fail_extension(path, names);
  }
  require_writable_folder(path);
}

void require_writable(const std::string& path, std::initializer_list<io::Content> contents) {
  if (path.empty()) return;
  if (!io::holds(path, contents)) fail_extension(path, io::extensions_of(contents));
  require_writable_folder(path);
}

void make_folder(const std::string& path) {
  std::error_code error;
  std::filesystem::create_directories(path, error);
  if (error) throw IoError(path + ": cannot make this folder: " + error.message());
}

void require_control_point(Index control_point, Eigen::Index count) {
  if (control_point >= 0 && control_point < count) return;
  throw OptionError("--control-point must be in [0, " + std::to_string(count - 1) + "], not " +
                    std::to_string(control_point));
}

void write_text(const std::string& path, const std::string& text) {
  const HeldSignals held;
  io::write_file(path, [&](std::ostream& file) { file << text; });
}

std::string describe_weight_file() {
  return std::string("weights, one row per vertex and one column per control point: ") +
         kWeightFormats;
}

std::string mesh_formats() {
  return io::extensions_of({io::Content::kMesh2D}) + " in 2D, " +
         io::extensions_of({io::Content::kMesh3D}) + " in 3D";
}

void require_distinct(const std::vector<std::string>& inputs,
                      const std::vector<std::string>& outputs) {
  for (std::size_t k = 0; k < outputs.size(); ++k) {
    for (const auto& input : inputs) {
      if (is_same_file(outputs[k], input)) {
        throw OptionError(outputs[k] +
                          ": the result would replace this input file; choose another name");
      }
    }
    for (std::size_t l = 0; l < k; ++l) {
      if (is_same_file(outputs[k], outputs[l])) {
        throw OptionError(outputs[k] + ": two results have this name; choose different names");
      }
    }
  }
}

template std::vector<Defect> defects_of(const Cage<2>&, std::size_t);
template std::vector<Defect> defects_of(const Cage<3>&, std::size_t);
template PointList<2> load_points(const std::string&);
template PointList<3> load_points(const std::string&);
template PointList<2> load_model(const std::string&);
template PointList<3> load_model(const std::string&);

}  // namespace flbc::app
