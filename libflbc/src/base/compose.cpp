// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/compose.h"

#include <cmath>
#include <string>

#include "base/messages.h"
#include "flbc/errors.h"

namespace flbc {
namespace {

void require_stochastic(const SparseWeights& map) {
  constexpr double kSumError = 1e-9;
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
    if (std::abs(sum - 1) <= kSumError) continue;
    throw InputError("the weights of control point " + std::to_string(i) + " in the map sum to " +
                     format_number(sum) + "; they must sum to 1");
  }
}

}  // namespace

SparseWeights compose(const SparseWeights& weights, const SparseWeights& map) {
  if (weights.num_control_points() != map.num_points()) {
    throw InputError("the weights are for " + std::to_string(weights.num_control_points()) +
                     " control points, but the map has weights of " +
                     std::to_string(map.num_points()));
  }
  require_stochastic(map);
  const Index m = map.num_control_points();
  return SparseWeights::of(m, weights.num_points(), [&](Index p) {
    Eigen::VectorXd sums = Eigen::VectorXd::Zero(m);
    weights.visit(p, [&](Index i, double weight) {
      map.visit(i, [&](Index j, double share) { sums[j] += weight * share; });
    });
    return sums;
  });
}

}  // namespace flbc
