// SPDX-License-Identifier: BSD-3-Clause
// What a format has no place for is told in words, so that nothing is lost silently.
#include <algorithm>
#include <utility>

#include "flbc/errors.h"
#include "flbc/io/files.h"
#include "flbc/io/model_file.h"
#include "model/model_attributes.h"
#include "model/model_scan.h"

namespace flbc::io {
namespace {

template <class Matrix>
bool are_single(const Matrix& numbers) {
  return numbers.template cast<float>().template cast<double>() == numbers;
}

bool are_single(const std::vector<Vector<3>>& points) {
  return std::all_of(points.begin(), points.end(),
                     [](const auto& point) { return are_single<Vector<3>>(point); });
}

// Levels written as decimals with a few digits are meant to be these levels.
bool are_levels(const PointList<3>& colors) {
  constexpr double kDigits = 1e-3;
  const Eigen::ArrayXXd levels = 255 * colors.array();
  return ((levels - levels.round()).abs() <= kDigits).all();
}

bool has_larger_polygons(const Model& model) {
  const auto& polygons = model.soup.polygons;
  return std::any_of(polygons.begin(), polygons.end(),
                     [](const auto& polygon) { return polygon.size() > 3; });
}

class Losses {
 public:
  Losses(const Model& model, std::string extension)
      : model_(model), extension_(std::move(extension)), phrases_(model.others) {}

  std::vector<std::string> find() {
    add_if(extension_ != "obj" && !model_.soup.polylines.empty(), "polylines");
    if (extension_ == "stl") {
      add_losses_of_stl();
    } else if (extension_ != "obj") {
      add_losses_of_vertices();
    }
    return phrases_;
  }

 private:
  void add_if(bool is_lost, const char* phrase) {
    if (is_lost) phrases_.emplace_back(phrase);
  }

  void add_losses_of_stl() {
    const auto& attributes = model_.attributes;
    add_if(true, "the order of the vertices");
    add_if(!are_single(model_.soup.points), "coordinates beyond single precision");
    add_if(has_larger_polygons(model_), "polygons (they are cut into triangles)");
    add_if(attributes.colors.cols() > 0, "colours");
    add_if(attributes.normals.cols() > 0, "normals of vertices");
    add_if(attributes.texture_coordinates.cols() > 0, "texture coordinates");
  }

  // Of formats whose attributes belong to vertices.
  void add_losses_of_vertices() {
    const auto texture = texture_coordinates_at_vertices(model_);
    add_if(!normals_at_vertices(model_), "normals (they differ between corners of a vertex)");
    add_if(!texture, "texture coordinates (they differ between corners of a vertex)");
    add_if(extension_ == "om" && texture && !are_single(*texture),
           "texture coordinates beyond single precision");
    add_if(!are_levels(model_.attributes.colors), "colours beyond 256 levels");
  }

  const Model& model_;
  std::string extension_;
  std::vector<std::string> phrases_;
};

}  // namespace

std::vector<std::string> losses(const Model& model, const std::string& path) {
  return Losses(model, extension_of(path)).find();
}

void write_model(const std::string& path, const Model& model) {
  using Writer = void (*)(std::ostream&, const Model&);
  const std::pair<const char*, Writer> writers[] = {
      {"obj", write_obj}, {"off", write_off}, {"ply", write_ply}, {"stl", write_stl}};
  for (const auto& [extension, write] : writers) {
    if (extension_of(path) != extension) continue;
    return write_file(path, [&, write = write](std::ostream& out) { write(out, model); });
  }
  throw OptionError(path + ": a model is written to .obj, .off, .ply or .stl");
}

}  // namespace flbc::io
