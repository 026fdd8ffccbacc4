// SPDX-License-Identifier: BSD-3-Clause
// The poses of a cage, from cage files or an animation, and how far they move a model.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "flbc/cage.h"
#include "flbc/deform.h"
#include "flbc/io/model.h"
#include "flbc/types.h"
#include "gltf/skin.h"
#include "poses/moved_by.h"

namespace flbc::app {

template <int Dim>
struct Pose {
  std::string name;         //!< the file, for keyframes with the number: for messages
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

//! 2 or 3: as io::to_cage() decides, but by the points only where facets would not do, because
//! poses need none.
int dimension_of_cage(const std::string& path);

//! A cage at rest as its file has it, and its poses in other files. Poses need not be sound cages:
//! a pose may intersect itself.
template <int Dim>
class RestCage {
 public:
  //! \param quiet  prints no notes
  explicit RestCage(const std::string& path, bool quiet = false);
  //! A cage that no file has yet.
  RestCage(const Cage<Dim>& cage, std::string name, bool quiet = false);

  const PointList<Dim>& points() const { return points_; }

  //! The cage; without facets if the file has none, or is no cage of this dimension.
  Cage<Dim> cage() const;

  //! The control points in another file, in the order of this cage. A note that the file has them
  //! in another order goes to the standard error output.
  //! \throws InputError unless the file has the same control points and faces
  PointList<Dim> load_pose(const std::string& path) const;

 private:
  io::PolygonSoup polygons_;
  std::string name_;  // for messages
  bool quiet_;
  PointList<Dim> points_;
};

//! Frames per second of a sequence: as asked, or, if that is 0, a single pose within a second and
//! several as a video.
double frame_rate(std::size_t num_poses, double asked);

//! One pose per file, `frames_per_second` of them in a second, the first one at 0.
template <int Dim>
std::vector<Pose<Dim>> load_poses(const CageFiles& files, const RestCage<Dim>& rest,
                                  double frames_per_second = 1);

//! The poses at their times.
template <int Dim>
gltf::Animation<Dim> animation_of(const std::vector<Pose<Dim>>& poses);

//! One pose per keyframe, at its time; in 2D displacements along z are passed over.
//! \throws InputError if the file is for another number of control points than `rest` (Dim x n) has
template <int Dim>
std::vector<Pose<Dim>> load_keyframes(const std::string& path, const PointList<Dim>& rest);

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

//! \param points  Dim x P, where the model rests
template <int Dim>
Displacement measure_displacement(const MovedBy<Dim>& moved, const PointList<Dim>& points,
                                  const std::vector<Pose<Dim>>& poses) {
  Displacement result;
  result.lengths.resize(static_cast<Eigen::Index>(poses.size()), points.cols());
  for (std::size_t k = 0; k < poses.size(); ++k) {
    result.lengths.row(static_cast<Eigen::Index>(k)) =
        displacements<Dim>(points, moved.at(poses[k].points)).transpose();
  }
  if (result.lengths.size() == 0) return result;
  Eigen::Index pose = 0;
  result.largest = result.lengths.maxCoeff(&pose, &result.point);
  result.pose = static_cast<std::size_t>(pose);
  return result;
}

}  // namespace flbc::app
