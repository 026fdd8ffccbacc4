// SPDX-License-Identifier: BSD-3-Clause
#include "evaluation/weight_difference.h"

#include <string>

#include "flbc/errors.h"

namespace flbc {

SparseWeights difference_of(const SparseWeights& before, const SparseWeights& after) {
  const Index num_points = after.num_points();
  const Index n = after.num_control_points();
  if (before.num_points() != num_points || before.num_control_points() != n) {
    throw InputError("weights of " + std::to_string(before.num_points()) + " points and " +
                     std::to_string(before.num_control_points()) +
                     " control points cannot be compared with " + std::to_string(num_points) +
                     " points and " + std::to_string(n) + " control points");
  }
  return SparseWeights::of(n, num_points, [&](Index p) {
    Eigen::VectorXd difference = after.at(p);
    before.visit(p, [&](Index i, double weight) { difference[i] -= weight; });
    return difference;
  });
}

}  // namespace flbc
