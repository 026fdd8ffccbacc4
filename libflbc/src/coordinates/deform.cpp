// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/deform.h"

#include <string>

#include "base/parallel.h"
#include "coordinates/weighted_sums.h"
#include "flbc/errors.h"

namespace flbc {
namespace {

void check_pose(Eigen::Index in_weights, Eigen::Index in_pose) {
  if (in_weights == in_pose) return;
  throw InputError("the weights are for " + std::to_string(in_weights) +
                   " control points, but the pose has " + std::to_string(in_pose));
}

}  // namespace

template <int Dim>
PointList<Dim> deform(const SparseWeights& weights, const PointList<Dim>& control_points,
                      int threads) {
  check_pose(weights.num_control_points(), control_points.cols());
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

template PointList<2> deform(const SparseWeights&, const PointList<2>&, int);
template PointList<3> deform(const SparseWeights&, const PointList<3>&, int);
template Eigen::VectorXd displacements(const PointList<2>&, const PointList<2>&);
template Eigen::VectorXd displacements(const PointList<3>&, const PointList<3>&);

}  // namespace flbc
