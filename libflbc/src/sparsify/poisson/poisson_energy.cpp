// SPDX-License-Identifier: BSD-3-Clause
#include "sparsify/poisson/poisson_energy.h"

#include <algorithm>
#include <cmath>
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

// The expectation over poses of both kinds, without I, each of which displaces by about a tenth of
// the size. In an independent pose the displacements u_i of the control points have no correlation,
// so that |sum d_i u_i|^2 is |d|^2 on average. In a smooth one the displacement at place p is A p +
// (p . B_k p)_k, all entries uniform in [-1, 1], of variance 1/3. The average is a sum over
// products of places, and their products of degree two.
template <int Dim>
Eigen::MatrixXd smooth_expectation(const PointList<Dim>& control_points, double size) {
  const PointList<Dim> places =
      2 / size * (control_points.colwise() - control_points.rowwise().mean());
  const Eigen::MatrixXd products = places.transpose().lazyProduct(places);
  return Dim / 3.0 * (products + products.cwiseProduct(products));
}

// F with F^T F = G up to rounding, r x n, by a Cholesky decomposition that stops at the rank r of
// G. The rank is small because few numbers describe a pose.
Eigen::MatrixXd low_rank_factor(const Eigen::MatrixXd& gram) {
  constexpr double kRounding = 1e-14;  // of the largest entry
  Eigen::VectorXd rest = gram.diagonal();
  const double least = kRounding * rest.maxCoeff();
  Eigen::MatrixXd factor(gram.rows(), gram.cols());
  Eigen::Index rank = 0;
  for (Eigen::Index pivot; rank < gram.rows() && rest.maxCoeff(&pivot) > least; ++rank) {
    const auto before = factor.topRows(rank);
    const double root = std::sqrt(rest[pivot]);
    factor.row(rank) =
        (gram.row(pivot) - (before.col(pivot).transpose().lazyProduct(before))) / root;
    rest -= factor.row(rank).cwiseAbs2().transpose();
    rest[pivot] = 0;
  }
  return factor.topRows(rank);
}

}  // namespace

template <int Dim>
PoseMetric pose_metric(const PointList<Dim>& control_points,
                       const std::vector<PointList<Dim>>& poses) {
  const double size = scale_of<Dim>(control_points);
  const double general = poses.empty() ? 1 : kGeneral;
  Eigen::MatrixXd gram = general * smooth_expectation<Dim>(control_points, size);
  for (const auto& pose : poses) {
    // Centers the pose. Its translation has no effect because sum d = 0, but would lose digits.
    const PointList<Dim> places = 10 / size * (pose.colwise() - pose.rowwise().mean());
    gram += places.transpose().lazyProduct(places) / static_cast<double>(poses.size());
  }
  PoseMetric metric{general, low_rank_factor(gram), gram};
  metric.matrix.diagonal().array() += general;
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
                const SparseWeights& before, const SparseWeights& after) {
  const auto& metric = energy.metric;
  const auto square = [&](const Eigen::VectorXd& difference) {
    return metric.identity * difference.squaredNorm() + (metric.factor * difference).squaredNorm();
  };
  return parallel_sum<double>(
      static_cast<Index>(edges.ends.size()), 0, [&](Index begin, Index end) {
        double sum = 0;
        for (Index e = begin; e < end; ++e) {
          const auto [a, b] = edges.ends[e];
          const double weight = edges.weights.empty() ? 1 : edges.weights[e];
          const double pin = energy.pin * (points.col(a) - points.col(b)).squaredNorm() / 2;
          const Eigen::VectorXd at_a = after.at(a) - before.at(a),
                                at_b = after.at(b) - before.at(b);
          sum += weight * (square(at_a - at_b) + pin * (square(at_a) + square(at_b)));
        }
        return sum;
      });
}

FLBC_INSTANTIATE_FUNCTION(pose_metric)
FLBC_INSTANTIATE_FUNCTION(make_poisson_energy)
FLBC_INSTANTIATE_FUNCTION(evaluate)

}  // namespace flbc
