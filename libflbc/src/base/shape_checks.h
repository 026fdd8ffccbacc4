// SPDX-License-Identifier: BSD-3-Clause
// Checks that sizes of weights, points, control points, and poses match.
#pragma once

#include <string>
#include <vector>

#include "base/messages.h"
#include "flbc/errors.h"
#include "flbc/sparse_weights.h"

namespace flbc {

//! \throws InputError if weights, n x P, are not num_control_points x num_points
inline void check_size(Eigen::Index n, Eigen::Index P, Eigen::Index num_control_points,
                       Eigen::Index num_points) {
  if (n == num_control_points && P == num_points) return;
  throw InputError("weights for " + std::to_string(P) + " points and " + std::to_string(n) +
                   " control points do not match " + std::to_string(num_points) + " points and " +
                   std::to_string(num_control_points) + " control points");
}

inline void check_size(const WeightMatrix& weights, Eigen::Index num_control_points,
                       Eigen::Index num_points) {
  check_size(weights.rows(), weights.cols(), num_control_points, num_points);
}
inline void check_size(const SparseWeights& weights, Eigen::Index num_control_points,
                       Eigen::Index num_points) {
  check_size(weights.num_control_points(), weights.num_points(), num_control_points, num_points);
}

//! \throws InputError naming the first non-finite point
template <int Dim>
void check_finite(const PointList<Dim>& points) {
  for (Eigen::Index p = 0; p < points.cols(); ++p) {
    if (points.col(p).allFinite()) continue;
    throw InputError("point " + std::to_string(p) + " at " + format_point(points.col(p)) +
                     " is not finite");
  }
}

//! \throws InputError naming the first pose that is not finite or does not have `n` control points
template <int Dim>
void check_poses(const std::vector<PointList<Dim>>& poses, Eigen::Index n) {
  for (std::size_t k = 0; k < poses.size(); ++k) {
    const std::string name = "pose " + std::to_string(k);
    if (poses[k].cols() != n) {
      throw InputError(name + " has " + std::to_string(poses[k].cols()) +
                       " control points, but the weights are for " + std::to_string(n));
    }
    if (!poses[k].allFinite()) throw InputError(name + " has a number that is not finite");
  }
}

}  // namespace flbc
