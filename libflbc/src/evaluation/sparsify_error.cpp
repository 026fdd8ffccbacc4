// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/sparsify_error.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "flbc/errors.h"

namespace flbc {
namespace {

void check_same_size(const WeightMatrix& before, const WeightMatrix& after) {
  if (before.rows() == after.rows() && before.cols() == after.cols()) return;
  throw InputError("weights of " + std::to_string(before.cols()) + " points and " +
                   std::to_string(before.rows()) + " control points cannot be compared with " +
                   std::to_string(after.cols()) + " points and " + std::to_string(after.rows()) +
                   " control points");
}

}  // namespace

Influences count_influences(const WeightMatrix& weights) {
  if (weights.size() == 0) return {};
  const auto counts = (weights.array() != 0).cast<Index>().colwise().sum().eval();
  return {counts.cast<double>().mean(), counts.maxCoeff()};
}

ErrorNorms weight_error(const WeightMatrix& before, const WeightMatrix& after) {
  check_same_size(before, after);
  if (before.size() == 0) return {};
  const auto difference = (after - before).eval();
  return {std::sqrt(difference.squaredNorm() / static_cast<double>(difference.size())),
          difference.cwiseAbs().maxCoeff()};
}

template <int Dim>
ErrorNorms deformation_error(const std::vector<PointList<Dim>>& poses, const WeightMatrix& before,
                             const WeightMatrix& after) {
  check_same_size(before, after);
  if (before.size() == 0 || poses.empty()) return {};
  const WeightMatrix difference = after - before;
  double sum = 0, max = 0;
  for (const auto& pose : poses) {
    if (pose.cols() != before.rows()) {
      throw InputError("a pose has " + std::to_string(pose.cols()) +
                       " control points, but the weights are for " + std::to_string(before.rows()));
    }
    const Eigen::VectorXd distances = (pose * difference).colwise().norm();
    sum += distances.squaredNorm();
    max = std::max(max, distances.maxCoeff());
  }
  return {std::sqrt(sum / static_cast<double>(before.cols()) / static_cast<double>(poses.size())),
          max};
}

template ErrorNorms deformation_error(const std::vector<PointList<2>>&, const WeightMatrix&,
                                      const WeightMatrix&);
template ErrorNorms deformation_error(const std::vector<PointList<3>>&, const WeightMatrix&,
                                      const WeightMatrix&);

}  // namespace flbc
