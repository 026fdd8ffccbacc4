// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/sparsify_error.h"

#include <algorithm>
#include <cmath>

#include "base/instantiate.h"
#include "base/shape_checks.h"
#include "flbc/deform.h"

namespace flbc {
namespace {

// \return after - before, of P points
SparseWeights difference_of(const SparseWeights& before, const SparseWeights& after) {
  check_size(before, after.num_control_points(), after.num_points());
  return SparseWeights::of(after.num_control_points(), after.num_points(), [&](Index p) {
    Eigen::VectorXd difference = after.at(p);
    before.visit(p, [&](Index i, double weight) { difference[i] -= weight; });
    return difference;
  });
}

}  // namespace

Influences count_influences(const SparseWeights& weights, double threshold) {
  if (weights.num_points() == 0) return {};
  Influences influences;
  for (Index p = 0; p < weights.num_points(); ++p) {
    Index count = 0;
    weights.visit(p, [&](Index, double weight) { count += std::abs(weight) > threshold ? 1 : 0; });
    influences.max = std::max(influences.max, count);
    influences.mean += count;
  }
  influences.mean /= weights.num_points();
  return influences;
}

ErrorNorms weight_error(const SparseWeights& before, const SparseWeights& after) {
  const auto difference = difference_of(before, after);
  const Eigen::Map<const Eigen::VectorXd> values(
      difference.values().data(), static_cast<Eigen::Index>(difference.values().size()));
  if (values.size() == 0) return {};
  const double count = static_cast<double>(after.num_points()) * after.num_control_points();
  return {std::sqrt(values.squaredNorm() / count), values.cwiseAbs().maxCoeff()};
}

template <int Dim>
ErrorNorms deformation_error(const std::vector<PointList<Dim>>& poses, const SparseWeights& before,
                             const SparseWeights& after) {
  const auto difference = difference_of(before, after);
  if (difference.num_points() == 0 || poses.empty()) return {};
  double sum = 0, max = 0;
  for (const auto& pose : poses) {
    const Eigen::VectorXd distances = deform<Dim>(difference, pose).colwise().norm();
    sum += distances.squaredNorm();
    max = std::max(max, distances.maxCoeff());
  }
  const double count =
      static_cast<double>(difference.num_points()) * static_cast<double>(poses.size());
  return {std::sqrt(sum / count), max};
}

template <int Dim>
ErrorNorms edge_error(const PointList<Dim>& points, const EdgeList& edges,
                      const std::vector<PointList<Dim>>& poses, const SparseWeights& before,
                      const SparseWeights& after) {
  check_poses<Dim>(poses, before.num_control_points());
  check_size(before, before.num_control_points(), points.cols());
  validate(edges, points.cols());
  const auto difference = difference_of(before, after);
  double sum = 0, rest = 0;
  ErrorNorms norms;
  for (const auto& pose : poses) {
    const auto errors = deform<Dim>(difference, pose);
    for (std::size_t e = 0; e < edges.ends.size(); ++e) {
      const auto [a, b] = edges.ends[e];
      const double weight = edges.weights.empty() ? 1 : edges.weights[e];
      const double length = (points.col(a) - points.col(b)).norm();
      const double error = (errors.col(a) - errors.col(b)).norm();
      sum += weight * error * error;
      rest += weight * length * length;
      if (length > 0) norms.max = std::max(norms.max, error / length);
    }
  }
  if (rest > 0) norms.rms = std::sqrt(sum / rest);
  return norms;
}

FLBC_INSTANTIATE_FUNCTION(deformation_error)
FLBC_INSTANTIATE_FUNCTION(edge_error)

}  // namespace flbc
