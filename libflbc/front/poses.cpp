// SPDX-License-Identifier: BSD-3-Clause
#include "front/poses.h"

#include <algorithm>
#include <filesystem>
#include <numeric>

#include "flbc/domain_mesh.h"
#include "flbc/errors.h"
#include "flbc/green.h"
#include "flbc/io/cage_io.h"
#include "flbc/io/model_file.h"
#include "front/instantiate.h"
#include "front/model_facets.h"

namespace flbc::app {
namespace {

struct Place {
  std::size_t begin = std::string::npos;
  std::size_t end = std::string::npos;
  std::size_t width = 0;
};

// The first %d or %0Nd from `start` on. Other percent signs are part of the name.
Place find_place(const std::string& name, std::size_t start = 0) {
  constexpr std::size_t kMostDigits = 2;
  for (auto begin = name.find('%', start); begin != std::string::npos;
       begin = name.find('%', begin + 1)) {
    const auto end = name.find_first_not_of("0123456789", begin + 1);
    if (end == std::string::npos || name[end] != 'd') continue;
    const auto digits = name.substr(begin + 1, end - begin - 1);
    if (digits.size() > kMostDigits) continue;
    return {begin, end + 1, digits.empty() ? 0 : std::stoul(digits)};
  }
  return {};
}

struct NumberedFile {
  std::string path;
  std::int64_t number;
};

// The files of a pattern that exist: from number 0 or else 1 up to the first one missing.
std::vector<NumberedFile> find_files(const std::string& pattern) {
  std::error_code error;
  const auto exists = [&](std::int64_t number) {
    return std::filesystem::exists(with_number(pattern, number), error);
  };
  std::vector<NumberedFile> files;
  for (std::int64_t number = exists(0) ? 0 : 1; exists(number); ++number) {
    files.push_back({with_number(pattern, number), number});
  }
  if (files.empty()) {
    throw IoError(pattern + ": there is neither " + with_number(pattern, 0) + " nor " +
                  with_number(pattern, 1));
  }
  return files;
}

}  // namespace

bool has_number(const std::string& pattern) {
  const auto place = find_place(pattern);
  if (place.begin == std::string::npos) return false;
  if (find_place(pattern, place.end).begin != std::string::npos) {
    throw OptionError(pattern + ": there must be one %d in the name, not several");
  }
  return true;
}

std::string with_number(const std::string& pattern, std::int64_t number) {
  if (!has_number(pattern)) return pattern;
  const auto place = find_place(pattern);
  auto digits = std::to_string(number);
  if (digits.size() < place.width) digits.insert(0, place.width - digits.size(), '0');
  return pattern.substr(0, place.begin) + digits + pattern.substr(place.end);
}

CageFiles find_cages(const std::vector<std::string>& cages) {
  // A file that is there is a file, whatever its name.
  const auto is_pattern = [](const std::string& name) {
    std::error_code error;
    return !std::filesystem::exists(name, error) && has_number(name);
  };
  CageFiles files;
  for (const auto& cage : cages) {
    if (!is_pattern(cage)) {
      files.paths.push_back(cage);
      continue;
    }
    for (const auto& file : find_files(cage)) {
      files.paths.push_back(file.path);
      files.numbers.push_back(file.number);
    }
  }
  if (cages.size() == 1 && is_pattern(cages.front())) return files;
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
RestCage<Dim>::RestCage(const std::string& path)
    : polygons_(io::control_polygons<Dim>(io::read_polygons(path))),
      name_(path),
      points_(io::to_points<Dim>(polygons_, path)) {
}

template <int Dim>
RestCage<Dim>::RestCage(const Cage<Dim>& cage, std::string name)
    : polygons_(io::control_polygons<Dim>(io::cage_polygons(cage))),
      name_(std::move(name)),
      points_(cage.points) {
}

template <int Dim>
Cage<Dim> RestCage<Dim>::cage() const {
  if (polygons_.polygons.empty()) return {points_, {}};
  try {
    auto cage = io::to_cage(polygons_, name_);
    if (auto* of_dimension = std::get_if<Cage<Dim>>(&cage)) return std::move(*of_dimension);
  } catch (const InputError&) {  // points suffice to move a model
  }
  return {points_, {}};
}

template <int Dim>
PointList<Dim> RestCage<Dim>::load_pose(const std::string& path) const {
  return io::read_pose<Dim>(path, polygons_, name_);
}

template <int Dim>
gltf::Animation<Dim> animation_of(const std::vector<Pose<Dim>>& poses, const PointList<Dim>* rest) {
  gltf::Animation<Dim> animation;
  if (rest != nullptr) animation = {{0}, {*rest}};
  for (const auto& pose : poses) {
    animation.times.push_back(pose.time);
    animation.poses.push_back(pose.points);
  }
  return animation;
}

template <int Dim>
std::vector<Pose<Dim>> load_poses(const PoseArguments& arguments, const CageFiles& files,
                                  const RestCage<Dim>& rest, int first) {
  constexpr double kVideo = 24;
  const double usual = files.paths.size() == 1 ? 1 : kVideo;
  const double rate = arguments.frames_per_second > 0 ? arguments.frames_per_second : usual;
  std::vector<Pose<Dim>> poses;
  for (std::size_t k = 0; k < files.paths.size(); ++k) {
    poses.push_back({files.paths[k], files.numbers[k], rest.load_pose(files.paths[k]),
                     (static_cast<double>(k) + first) / rate});
  }
  return poses;
}

template <int Dim>
Index main_control_point(const SparseWeights& weights, const PointList<Dim>& rest,
                         const std::vector<Pose<Dim>>& poses) {
  Eigen::VectorXd shares = Eigen::VectorXd::Zero(rest.cols());
  for (Index p = 0; p < weights.num_points(); ++p) {
    weights.visit(p, [&](Index i, double weight) { shares[i] += weight; });
  }
  Eigen::VectorXd moved = Eigen::VectorXd::Zero(rest.cols());
  for (const auto& pose : poses) {
    moved += shares.cwiseProduct(displacements<Dim>(rest, pose.points));
  }
  Eigen::Index chosen = 0;
  (moved.isZero(0) ? shares : moved).maxCoeff(&chosen);
  return static_cast<Index>(chosen);
}

template <int Dim>
Motion<Dim> by_green_coordinates(const Cage<Dim>& cage, const PointList<Dim>& points) {
  return [cage, weights = SparseWeights(green_coordinates(cage, points))](
             const PointList<Dim>& pose) -> PointList<Dim> {
    return deform<Dim>(weights, control_points_and_normals(cage, pose));
  };
}

template class RestCage<2>;
template class RestCage<3>;
FLBC_INSTANTIATE_FUNCTION(by_green_coordinates)
FLBC_INSTANTIATE_FUNCTION(load_poses)
FLBC_INSTANTIATE_FUNCTION(animation_of)
FLBC_INSTANTIATE_FUNCTION(main_control_point)

}  // namespace flbc::app
