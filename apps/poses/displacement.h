// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! How far a model moves from where it rests, over all its poses.
#pragma once

#include <cstddef>
#include <vector>

#include "flbc/deform.h"
#include "poses/poses.h"

namespace flbc::app {

//! The lengths of the displacements, and the largest of all.
struct Displacement {
  Eigen::MatrixXd lengths{};  //!< number of poses x P
  double largest = 0;
  Eigen::Index point = 0;  //!< that moves farthest
  std::size_t pose = 0;    //!< in which it does
};

//! \param points  Dim x P, where the model rests
template <int Dim>
Displacement measure_displacement(const SparseWeights& weights, const PointList<Dim>& points,
                                  const std::vector<Pose<Dim>>& poses) {
  Displacement result;
  result.lengths.resize(static_cast<Eigen::Index>(poses.size()), points.cols());
  for (std::size_t k = 0; k < poses.size(); ++k) {
    result.lengths.row(static_cast<Eigen::Index>(k)) =
        displacements(points, deform(weights, poses[k].points)).transpose();
  }
  if (result.lengths.size() == 0) return result;
  Eigen::Index pose = 0;
  result.largest = result.lengths.maxCoeff(&pose, &result.point);
  result.pose = static_cast<std::size_t>(pose);
  return result;
}

}  // namespace flbc::app
