// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/sparsify_error.h"

#include <algorithm>
#include <cmath>

#include "base/instantiate.h"
#include "base/parallel.h"
#include "base/shape_checks.h"

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

// What the differences displace in every pose, Dim * number of poses x P: all poses at once,
// because finding the differences takes longer than multiplying them.
template <int Dim>
Eigen::MatrixXd displacements(const std::vector<PointList<Dim>>& poses,
                              const SparseWeights& difference) {
  check_poses<Dim>(poses, difference.num_control_points());
  const auto rows = static_cast<Eigen::Index>(Dim * poses.size());
  Eigen::MatrixXd control_points(rows, difference.num_control_points());
  for (std::size_t k = 0; k < poses.size(); ++k) {
    control_points.middleRows(static_cast<Eigen::Index>(Dim * k), Dim) = poses[k];
  }
  Eigen::MatrixXd moved = Eigen::MatrixXd::Zero(rows, difference.num_points());
  parallel_for(difference.num_points(), [&](Index p) {
    difference.visit(
        p, [&](Index i, double weight) { moved.col(p) += weight * control_points.col(i); });
  });
  return moved;
}

// The longest displacement. \param moved  Dim * number of poses
template <int Dim>
double longest(const Eigen::VectorXd& moved) {
  return moved.reshaped(Dim, moved.size() / Dim).colwise().norm().maxCoeff();
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
  const auto moved = displacements<Dim>(poses, difference);
  double max = 0;
  for (const auto& column : moved.colwise()) max = std::max(max, longest<Dim>(column));
  const double count = static_cast<double>(moved.size() / Dim);
  return {std::sqrt(moved.squaredNorm() / count), max};
}

template <int Dim>
ErrorNorms edge_error(const PointList<Dim>& points, const EdgeList& edges,
                      const std::vector<PointList<Dim>>& poses, const SparseWeights& before,
                      const SparseWeights& after) {
  check_poses<Dim>(poses, before.num_control_points());
  check_size(before, before.num_control_points(), points.cols());
  validate(edges, points.cols());
  if (poses.empty()) return {};
  const auto moved = displacements<Dim>(poses, difference_of(before, after));
  double sum = 0, rest = 0;
  ErrorNorms norms;
  for (std::size_t e = 0; e < edges.ends.size(); ++e) {
    const auto [a, b] = edges.ends[e];
    const double weight = edges.weights.empty() ? 1 : edges.weights[e];
    const double length = (points.col(a) - points.col(b)).norm();
    const Eigen::VectorXd error = moved.col(a) - moved.col(b);
    sum += weight * error.squaredNorm();
    rest += weight * length * length * static_cast<double>(poses.size());
    if (length > 0) norms.max = std::max(norms.max, longest<Dim>(error) / length);
  }
  if (rest > 0) norms.rms = std::sqrt(sum / rest);
  return norms;
}

FLBC_INSTANTIATE_FUNCTION(deformation_error)
FLBC_INSTANTIATE_FUNCTION(edge_error)

}  // namespace flbc
