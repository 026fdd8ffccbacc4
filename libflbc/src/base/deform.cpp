// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/deform.h"

#include <cmath>
#include <functional>
#include <string>

#include "base/instantiate.h"
#include "base/messages.h"
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

// \param tolerance  of sums
void require_stochastic(const SparseWeights& map, double tolerance) {
  for (Index i = 0; i < map.num_points(); ++i) {
    double sum = 0;
    map.visit(i, [&](Index j, double weight) {
      if (!(weight >= 0)) {
        throw InputError("the map gives control point " + std::to_string(i) + " the weight " +
                         format_number(weight) + " for " + std::to_string(j) +
                         "; weights must be at least 0");
      }
      sum += weight;
    });
    if (std::abs(sum - 1) <= tolerance) continue;
    throw InputError("the weights of control point " + std::to_string(i) + " in the map sum to " +
                     format_number(sum) + "; they must sum to 1");
  }
}

// \param tolerance  of the sums of the map \param finish  changes the m sums of each point
SparseWeights product(const SparseWeights& weights, const SparseWeights& map, double tolerance,
                      const std::function<void(Eigen::VectorXd&)>& finish) {
  if (weights.num_control_points() != map.num_points()) {
    throw InputError("the weights are for " + std::to_string(weights.num_control_points()) +
                     " control points, but the map has weights of " +
                     std::to_string(map.num_points()));
  }
  require_stochastic(map, tolerance);
  const Index m = map.num_control_points();
  return SparseWeights::of(m, weights.num_points(), [&](Index p) {
    Eigen::VectorXd sums = Eigen::VectorXd::Zero(m);
    weights.visit(p, [&](Index i, double weight) {
      map.visit(i, [&](Index j, double share) { sums[j] += weight * share; });
    });
    finish(sums);
    return sums;
  });
}

}  // namespace

template <int Dim>
PointList<Dim> deform(const SparseWeights& weights, const PointList<Dim>& control_points,
                      int threads) {
  check_pose<Dim>(weights, control_points);
  PointList<Dim> points(Dim, weights.num_points());
  for_sums<Dim>(weights, control_points, threads,
                [&](Index p, const Vector<Dim>& sum) { points.col(p) = sum; });
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

SparseWeights compose(const SparseWeights& weights, const SparseWeights& map) {
  return product(weights, map, 1e-9, [](Eigen::VectorXd&) {});
}

SparseWeights skin(const SparseWeights& weights, const SparseWeights& bones, Index max_influences) {
  if (max_influences < 0) throw OptionError("the number of influences must be at least 0");
  // Files of bones have single precision.
  return product(weights, bones, 1e-6, [&](Eigen::VectorXd& sums) {
    sums = sums.cwiseMax(0);
    auto left = max_influences > 0 ? (sums.array() > 0).count() : 0;
    for (; left > max_influences; --left) {
      Eigen::Index least = 0;
      (sums.array() > 0).select(sums, 2).minCoeff(&least);
      sums[least] = 0;
    }
    if (sums.sum() > 0) sums /= sums.sum();
  });
}

FLBC_INSTANTIATE_FUNCTION(deform)
FLBC_INSTANTIATE_FUNCTION(displacements)

}  // namespace flbc
