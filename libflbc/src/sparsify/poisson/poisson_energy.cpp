// SPDX-License-Identifier: BSD-3-Clause
#include "sparsify/poisson/poisson_energy.h"

#include <algorithm>
#include <cstddef>

#include "base/parallel.h"
#include "base/shape_checks.h"
#include "flbc/bounding_box.h"
#include "sparsify/pose_metric.h"

namespace flbc {
namespace {

// Over shorter distances gradients count for more than positions. With longer ones gradients hardly
// get better, but positions worse, and descent slower.
constexpr double kReach = 0.05;        // of the points' size
constexpr double kReachOverEdges = 5;  // in mean lengths of an edge, for coarse meshes

template <int Dim>
double reach_of(const PointList<Dim>& points, const EdgeList& edges) {
  double sum = 0;
  for (const auto& [a, b] : edges.ends) sum += (points.col(a) - points.col(b)).norm();
  const double mean = sum / static_cast<double>(std::max<std::size_t>(1, edges.ends.size()));
  return std::max(kReach * bounding_box_diagonal<Dim>(points), kReachOverEdges * mean);
}

}  // namespace

template <int Dim>
PoissonEnergy make_poisson_energy(const PointList<Dim>& control_points,
                                  const PointList<Dim>& points, const EdgeList& edges,
                                  const std::vector<PointList<Dim>>& poses) {
  check_poses<Dim>(poses, control_points.cols());
  const double reach = reach_of<Dim>(points, edges);
  return {pose_metric<Dim>(control_points, poses), reach > 0 ? 1 / (reach * reach) : 0};
}

template <int Dim>
double evaluate(const PoissonEnergy& energy, const PointList<Dim>& points, const EdgeList& edges,
                const WeightMatrix& before, const WeightMatrix& after) {
  const WeightMatrix difference = after - before;
  const auto num_points = static_cast<Index>(difference.cols());
  Eigen::MatrixXd potential(difference.rows(), num_points);
#pragma omp parallel for schedule(static) if (num_points >= 256)
  for (Index a = 0; a < num_points; ++a) {
    potential.col(a).noalias() = energy.metric * difference.col(a);
  }
  const auto square = [&](Index a) { return difference.col(a).dot(potential.col(a)); };
  return parallel_sum<double>(
      static_cast<Index>(edges.ends.size()), 0, [&](Index begin, Index end) {
        double sum = 0;
        for (Index e = begin; e < end; ++e) {
          const auto [a, b] = edges.ends[e];
          const double weight = edges.weights.empty() ? 1 : edges.weights[e];
          const double pin = energy.pin * (points.col(a) - points.col(b)).squaredNorm() / 2;
          const auto step = difference.col(a) - difference.col(b);
          sum += weight *
                 (step.dot(potential.col(a) - potential.col(b)) + pin * (square(a) + square(b)));
        }
        return sum;
      });
}

#define FLBC_INSTANTIATE(Dim)                                                                      \
  template PoissonEnergy make_poisson_energy(const PointList<Dim>&, const PointList<Dim>&,         \
                                             const EdgeList&, const std::vector<PointList<Dim>>&); \
  template double evaluate(const PoissonEnergy&, const PointList<Dim>&, const EdgeList&,           \
                           const WeightMatrix&, const WeightMatrix&);
FLBC_INSTANTIATE(2)
FLBC_INSTANTIATE(3)
#undef FLBC_INSTANTIATE

}  // namespace flbc
