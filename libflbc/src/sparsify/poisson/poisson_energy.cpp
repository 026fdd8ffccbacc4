// SPDX-License-Identifier: BSD-3-Clause
#include "sparsify/poisson/poisson_energy.h"

#include <algorithm>
#include <cstddef>

#include "base/instantiate.h"
#include "base/parallel.h"
#include "base/shape_checks.h"
#include "flbc/bounding_box.h"
#include "polytope/scaling.h"

namespace flbc {
namespace {

// Length below which gradients dominate over positions. Larger values hardly improve gradients, but
// worsen positions and slow down descent.
constexpr double kReach = 0.05;        // relative to the size of the points
constexpr double kReachOverEdges = 5;  // in mean edge lengths, for coarse meshes

template <int Dim>
double reach_of(const PointList<Dim>& points, const EdgeList& edges) {
  double sum = 0;
  for (const auto& [a, b] : edges.ends) sum += (points.col(a) - points.col(b)).norm();
  const double mean = sum / static_cast<double>(std::max<std::size_t>(1, edges.ends.size()));
  return std::max(kReach * bounding_box_diagonal<Dim>(points), kReachOverEdges * mean);
}

// Weight of the expectation relative to the given poses.
constexpr double kGeneral = 0.1;

// The sum of the expectations over all poses of both kinds, each of which displaces by about a
// tenth of the size. In an independent pose the displacements u_i of the control points have no
// correlation, so that |sum d_i u_i|^2 is |d|^2 on average. In a smooth one the displacement at
// place p is A p + (p . B_k p)_k, all entries uniform in [-1, 1], of variance 1/3. The average is a
// sum over products of places, and their products of degree two.
template <int Dim>
Eigen::MatrixXd expectation(const PointList<Dim>& control_points, double size) {
  const PointList<Dim> places =
      2 / size * (control_points.colwise() - control_points.rowwise().mean());
  const Eigen::MatrixXd products = places.transpose().lazyProduct(places);
  Eigen::MatrixXd metric = Dim / 3.0 * (products + products.cwiseProduct(products));
  metric.diagonal().array() += 1;
  return metric;
}

}  // namespace

template <int Dim>
Eigen::MatrixXd pose_metric(const PointList<Dim>& control_points,
                            const std::vector<PointList<Dim>>& poses) {
  const double size = scale_of<Dim>(control_points);
  Eigen::MatrixXd metric = expectation<Dim>(control_points, size);
  if (poses.empty()) return metric;
  metric *= kGeneral;
  for (const auto& pose : poses) {
    // Centers the pose. Its translation has no effect because sum d = 0, but would lose digits.
    const PointList<Dim> places = 10 / size * (pose.colwise() - pose.rowwise().mean());
    metric += places.transpose().lazyProduct(places) / static_cast<double>(poses.size());
  }
  return metric;
}

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
  parallel_for(num_points,
               [&](Index a) { potential.col(a).noalias() = energy.metric * difference.col(a); });
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

FLBC_INSTANTIATE_FUNCTION(pose_metric)
FLBC_INSTANTIATE_FUNCTION(make_poisson_energy)
FLBC_INSTANTIATE_FUNCTION(evaluate)

}  // namespace flbc
