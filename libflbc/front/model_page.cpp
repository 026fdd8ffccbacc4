// SPDX-License-Identifier: BSD-3-Clause
#include "front/model_page.h"

#include <filesystem>
#include <system_error>
#include <variant>

#include "flbc/io/cage_io.h"
#include "flbc/io/files.h"
#include "flbc/io/model_file.h"
#include "front/instantiate.h"
#include "front/movable_model.h"

namespace flbc::app {

template <int Dim>
view::ShownCage<Dim> load_shown_cage(const std::string& path) {
  return cage_as_shown<Dim>(io::ModelFile(path), path);
}

template <int Dim>
view::ShownCage<Dim> cage_as_shown(const io::ModelFile& file, const std::string& path) {
  const auto& soup = file.model().soup;
  const auto cage = io::to_cage(soup, path);
  const auto polygons = io::control_polygons<Dim>(soup);
  view::ShownCage<Dim> shown;
  shown.points = io::to_points<Dim>(polygons, path);
  if (const auto* same = std::get_if<Cage<Dim>>(&cage)) shown.facets = same->facets;
  shown.edges = view::edges_of_cage<Dim>(polygons.polygons, shown.facets);
  // A pose is written into this text, which therefore has the control points and no other vertices.
  const bool has_others = soup.points.size() > polygons.points.size();
  if (io::extension_of(path) == "obj" && !has_others) shown.text = file.text();
  return shown;
}

template <int Dim>
view::ShownModel<Dim> load_shown_model(const std::string& path) {
  const MovedFile same{path, path};
  require_formats_of<Dim>(same);
  const MovableModel<Dim> model(same);
  const bool is_cloud = model.model() != nullptr && model.model()->soup.polygons.empty();
  return {model.points(), is_cloud ? gltf::Surface() : model.surface()};
}

template <int Dim>
void look_from_front(view::PageContent<Dim>& content, UpAxis up) {
  content.up = up_axis(up, content.points);
  const bool is_known = Dim == 2 || up != UpAxis::kAuto;  // as for glTF
  if constexpr (Dim == 3) content.front = is_known ? 0 : front_azimuth(content.up, content.points);
}

template <int Dim>
std::vector<view::ShownPose<Dim>> shown_poses(const std::vector<Pose<Dim>>& poses) {
  std::vector<view::ShownPose<Dim>> shown;
  for (const auto& pose : poses) {
    shown.push_back({std::filesystem::path(pose.name).filename().string(), pose.time, pose.points});
  }
  return shown;
}

std::string path_beside(const std::string& page, const std::string& file) {
  namespace fs = std::filesystem;
  std::error_code error;
  const auto folder = fs::absolute(page, error).parent_path();
  const auto path = fs::proximate(file, folder, error);
  return error ? file : path.string();
}

FLBC_INSTANTIATE_FUNCTION(load_shown_cage)
FLBC_INSTANTIATE_FUNCTION(cage_as_shown)
FLBC_INSTANTIATE_FUNCTION(load_shown_model)
FLBC_INSTANTIATE_FUNCTION(look_from_front)
FLBC_INSTANTIATE_FUNCTION(shown_poses)

}  // namespace flbc::app
