// SPDX-License-Identifier: BSD-3-Clause
// The poses of a cage, from cage files or an animation, and how far they move a model.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "flbc/cage.h"
#include "flbc/deform.h"
#include "flbc/io/model.h"
#include "flbc/types.h"
#include "gltf/skin.h"

namespace flbc::app {

template <int Dim>
struct Pose {
  std::string name;         //!< the file, for messages
  std::int64_t number;      //!< in the names of sequences
  PointList<Dim> points{};  //!< Dim x n
  double time = 0;          //!< in seconds
};

//! The files behind the patterns, each once per mention, and their numbers: those of the pattern if
//! there is nothing but one pattern, else counted from 0.
struct CageFiles {
  std::vector<std::string> paths{};
  std::vector<std::int64_t> numbers{};
};
CageFiles find_cages(const std::vector<std::string>& cages);

//! The poses that a command takes (commands/pose_options.h).
struct PoseArguments {
  std::vector<std::string> cages;  //!< files or a pattern of them
  double frames_per_second = 0;    //!< 0 = 24, or one second for a single pose

  bool empty() const { return cages.empty(); }
};

//! 2 or 3: as io::to_cage() decides, but by the points only where facets would not do, because
//! poses need none.
int dimension_of_cage(const std::string& path);

//! A cage at rest as its file has it, and its poses in other files. Poses need not be sound cages:
//! a pose may intersect itself.
template <int Dim>
class RestCage {
 public:
  explicit RestCage(const std::string& path);
  //! A cage that no file has yet.
  RestCage(const Cage<Dim>& cage, std::string name);

  const PointList<Dim>& points() const { return points_; }

  //! The cage; without facets if the file has none, or is no cage of this dimension.
  Cage<Dim> cage() const;

  //! The control points in another file.
  //! \throws InputError unless the file has the same control points in the same order
  PointList<Dim> load_pose(const std::string& path) const;

 private:
  io::PolygonSoup polygons_;
  std::string name_;  // for messages
  PointList<Dim> points_;
};

//! One pose per file.
//! \param files  of the arguments \param first  the time of the first file, in poses
template <int Dim>
std::vector<Pose<Dim>> load_poses(const PoseArguments& arguments, const CageFiles& files,
                                  const RestCage<Dim>& rest, int first = 0);

//! The poses at their times. \param rest  of the cage, before them at time 0; may be null
template <int Dim>
gltf::Animation<Dim> animation_of(const std::vector<Pose<Dim>>& poses, const PointList<Dim>* rest);

//! The control point that moves most of a model in the poses, or has the largest sum of weights.
template <int Dim>
Index main_control_point(const SparseWeights& weights, const PointList<Dim>& rest,
                         const std::vector<Pose<Dim>>& poses);

// Sequences of files are written as pose_%d.obj or pose_%03d.obj.

//! Whether a name has a place for a number. \throws OptionError if it has more than one
bool has_number(const std::string& pattern);

//! The name with the number in its place, with leading zeros up to the width between % and d. A
//! name without a place for it stays as it is.
std::string with_number(const std::string& pattern, std::int64_t number);

//! The lengths of the displacements, and the largest of all.
struct Displacement {
  Eigen::MatrixXd lengths{};  //!< number of poses x P
  double largest = 0;
  Eigen::Index point = 0;  //!< that moves farthest
  std::size_t pose = 0;    //!< in which it does
};

//! The points of a model, Dim x P, in a pose of the cage, Dim x n.
template <int Dim>
using Motion = std::function<PointList<Dim>(const PointList<Dim>& pose)>;

//! By Green coordinates. \throws InputError if a point is outside the cage
template <int Dim>
Motion<Dim> by_green_coordinates(const Cage<Dim>& cage, const PointList<Dim>& points);

//! \param points  Dim x P, where the model rests
template <int Dim>
Displacement measure_displacement(const Motion<Dim>& moved, const PointList<Dim>& points,
                                  const std::vector<Pose<Dim>>& poses) {
  Displacement result;
  result.lengths.resize(static_cast<Eigen::Index>(poses.size()), points.cols());
  for (std::size_t k = 0; k < poses.size(); ++k) {
    result.lengths.row(static_cast<Eigen::Index>(k)) =
        displacements<Dim>(points, moved(poses[k].points)).transpose();
  }
  if (result.lengths.size() == 0) return result;
  Eigen::Index pose = 0;
  result.largest = result.lengths.maxCoeff(&pose, &result.point);
  result.pose = static_cast<std::size_t>(pose);
  return result;
}

}  // namespace flbc::app
