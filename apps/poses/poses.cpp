// SPDX-License-Identifier: BSD-3-Clause
#include "poses/poses.h"

#include <algorithm>
#include <numeric>

#include "flbc/domain_mesh.h"
#include "flbc/errors.h"
#include "flbc/io/cage_io.h"
#include "flbc/io/keyframes.h"
#include "flbc/io/model_file.h"
#include "poses/file_sequence.h"

namespace flbc::app {

CageFiles find_cages(const std::vector<std::string>& cages) {
  CageFiles files;
  for (const auto& cage : cages) {
    if (!has_number(cage)) {
      files.paths.push_back(cage);
      continue;
    }
    for (const auto& file : find_files(cage)) {
      files.paths.push_back(file.path);
      files.numbers.push_back(file.number);
    }
  }
  if (cages.size() == 1 && has_number(cages.front())) return files;
  files.numbers.resize(files.paths.size());
  std::iota(files.numbers.begin(), files.numbers.end(), 0);
  return files;
}

int dimension_of_cage(const std::string& path) {
  const auto soup = io::read_polygons(path);
  if (!soup.polylines.empty()) return 2;
  const bool is_flat = std::all_of(soup.points.begin(), soup.points.end(), [&](const auto& point) {
    return point.z() == soup.points.front().z();
  });
  return soup.polygons.size() <= 1 && is_flat ? 2 : 3;
}

template <int Dim>
PointList<Dim> load_control_points(const std::string& path) {
  return io::to_points<Dim>(io::read_polygons(path), path);
}

template <int Dim>
FacetList<2> edges_of_cage(const io::PolygonSoup& soup) {
  PointList<3> points(3, soup.points.size());
  for (std::size_t i = 0; i < soup.points.size(); ++i) points.col(i) = soup.points[i];
  auto polylines = soup.polylines;
  if (Dim == 2 && polylines.empty() && soup.polygons.empty()) {
    auto& loop = polylines.emplace_back(soup.points.size());
    std::iota(loop.begin(), loop.end(), 0);
    loop.push_back(0);
  }
  const auto edges = edges_of_polygons<3>(points, soup.polygons, polylines).ends;
  FacetList<2> result(2, edges.size());
  for (std::size_t e = 0; e < edges.size(); ++e) result.col(e) << edges[e][0], edges[e][1];
  return result;
}

double frame_rate(std::size_t num_poses, double asked) {
  constexpr double kVideo = 24;
  if (asked > 0) return asked;
  return num_poses == 1 ? 1 : kVideo;
}

template <int Dim>
std::vector<Pose<Dim>> load_poses(const CageFiles& files, double frames_per_second) {
  std::vector<Pose<Dim>> poses;
  for (std::size_t k = 0; k < files.paths.size(); ++k) {
    poses.push_back({files.paths[k], files.numbers[k], load_control_points<Dim>(files.paths[k]),
                     static_cast<double>(k) / frames_per_second});
  }
  return poses;
}

template <int Dim>
gltf::Animation<Dim> animation_of(const std::vector<Pose<Dim>>& poses, Index num_control_points) {
  gltf::Animation<Dim> animation;
  for (const auto& pose : poses) {
    if (pose.points.cols() != num_control_points) {
      throw InputError(pose.name + ": has " + std::to_string(pose.points.cols()) +
                       " vertices, but the cage has " + std::to_string(num_control_points));
    }
    animation.times.push_back(pose.time);
    animation.poses.push_back(pose.points);
  }
  return animation;
}

template <int Dim>
std::vector<Pose<Dim>> load_keyframes(const std::string& path, const PointList<Dim>& rest) {
  const auto keyframes = io::read_keyframes(path);
  std::vector<Pose<Dim>> poses;
  for (const auto& keyframe : keyframes) {
    const auto number = static_cast<std::int64_t>(poses.size());
    if (keyframe.displacements.cols() != rest.cols()) {
      throw InputError(path + ": the keyframes are for " +
                       std::to_string(keyframe.displacements.cols()) +
                       " control points, but the rest cage has " + std::to_string(rest.cols()));
    }
    poses.push_back({path + ", keyframe " + std::to_string(number), number,
                     rest + keyframe.displacements.template topRows<Dim>(), keyframe.time});
  }
  return poses;
}

#define FLBC_INSTANTIATE(Dim)                                                                \
  template PointList<Dim> load_control_points(const std::string&);                           \
  template FacetList<2> edges_of_cage<Dim>(const io::PolygonSoup&);                          \
  template std::vector<Pose<Dim>> load_poses(const CageFiles&, double);                      \
  template std::vector<Pose<Dim>> load_keyframes(const std::string&, const PointList<Dim>&); \
  template gltf::Animation<Dim> animation_of(const std::vector<Pose<Dim>>&, Index);
FLBC_INSTANTIATE(2)
FLBC_INSTANTIATE(3)
#undef FLBC_INSTANTIATE

}  // namespace flbc::app
