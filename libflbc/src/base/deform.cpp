// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/deform.h"

#include <string>

#include "base/instantiate.h"
#include "base/parallel.h"
#include "base/shape_checks.h"
#include "base/weighted_sums.h"
#include "flbc/errors.h"

namespace flbc {
namespace {

template <int Dim>
void check_pose(const SparseWeights& weights, const PointList<Dim>& pose) {
  if (weights.num_control_points() != pose.cols()) {
    throw InputError("the weights are for " + std::to_string(weights.num_control_points()) +
                     " control points, but the pose has " + std::to_string(pose.cols()));
  }
  check_finite<Dim>(pose);
}

}  // namespace

template <int Dim>
PointList<Dim> deform(const SparseWeights& weights, const PointList<Dim>& control_points,
                      int threads) {
  check_pose<Dim>(weights, control_points);
  const Eigen::Index count = weights.num_points();
  PointList<Dim> points(Dim, count);
  const PaddedPoints<Dim> cage(control_points);
  const auto* starts = weights.starts().data();
  const auto* of = weights.control_points().data();
  const auto* values = weights.values().data();
  const ThreadScope scope(deform_threads(weights.values().size(), threads));
  parallel_for(count, [&](Eigen::Index p) {
    const auto start = starts[p];
    points.col(p) = cage.sum(values + start, of + start, starts[p + 1] - start);
  });
  return points;
}

template <int Dim>
Eigen::VectorXd displacements(const PointList<Dim>& before, const PointList<Dim>& after) {
  if (before.cols() != after.cols()) {
    throw InputError("there are " + std::to_string(before.cols()) + " points before and " +
                     std::to_string(after.cols()) + " after the move");
  }
  Eigen::VectorXd lengths(before.cols());
  // Squares of large displacements are not finite.
  for (Eigen::Index p = 0; p < before.cols(); ++p) {
    lengths[p] = (after.col(p) - before.col(p)).stableNorm();
  }
  return lengths;
}

FLBC_INSTANTIATE_FUNCTION(deform)
FLBC_INSTANTIATE_FUNCTION(displacements)

}  // namespace flbc
