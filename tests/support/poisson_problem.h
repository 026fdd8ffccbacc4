// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Weights on points with edges, to be made sparse.
#pragma once

#include "flbc/coordinates.h"
#include "flbc/sparsify.h"
#include "flbc/sparsify_error.h"
#include "support/feasible_vertices.h"

namespace flbc::testing {

inline SparsifyOptions at_most(Index count, double threshold = 0) {
  SparsifyOptions options;
  options.max_influences = count;
  options.threshold = threshold;
  return options;
}

template <int Dim>
struct PoissonProblem {
  PointList<Dim> control_points;
  PointList<Dim> points;
  EdgeList edges;
  WeightMatrix weights;

  WeightMatrix plain(const SparsifyOptions& options) const {
    return sparsify(control_points, points, weights, options).dense();
  }
  WeightMatrix reduce(const SparsifyOptions& options,
                      const std::vector<PointList<Dim>>& poses = {}) const {
    return reduce_by_poisson<Dim>(control_points, points, edges, weights, poses, options).dense();
  }
  double cost(const WeightMatrix& after, const std::vector<PointList<Dim>>& poses = {}) const {
    return poisson_cost<Dim>(control_points, points, edges, weights, after, poses);
  }
  ErrorNorms error(const WeightMatrix& after, const std::vector<PointList<Dim>>& poses) const {
    return edge_error<Dim>(points, edges, poses, weights, after);
  }
};

//! Local barycentric coordinates on the mesh of a sample, many of its vertices on the cage.
template <int Dim>
PoissonProblem<Dim> problem_on_a_mesh() {
  const auto sample = make_sample<Dim>(Shape::kRing, Dim == 2 ? 9 : 4, 0.1);
  // Harmonic coordinates: with local ones few influences are nearly all there are, and nothing but
  // what the solve leaves would be compared.
  const auto solution = compute_coordinates(sample.cage, sample.mesh, Coordinates::kHarmonic);
  return {sample.cage.points, sample.mesh.points, edges_of_cells(sample.mesh),
          solution.weights.dense()};
}

//! Points along a curve, each with edges to those one and five places before, with weights that
//! change smoothly but for some noise and are all positive.
template <int Dim>
PoissonProblem<Dim> problem_on_a_curve(const PointList<Dim>& control_points, int count,
                                       double noise) {
  Numbers numbers(21);
  const auto n = control_points.cols();
  const Eigen::VectorXd phases = numbers.matrix(n, 1, 0, 6);
  PoissonProblem<Dim> problem{control_points, {}, {}, WeightMatrix(n, count)};
  for (int v = 0; v < count; ++v) {
    for (Eigen::Index i = 0; i < n; ++i) {
      const double wave = std::sin(4.0 * v / count + phases[i]);
      problem.weights(i, v) = wave * wave + noise * numbers.uniform(0, 1);
    }
    problem.weights.col(v) /= problem.weights.col(v).sum();
    if (v > 0) problem.edges.ends.push_back({v - 1, v});
    if (v > 4) problem.edges.ends.push_back({v, v - 5});
  }
  problem.points = control_points * problem.weights;
  return problem;
}

//! The feasible weights with the least (w - t) . H (w - t) among those with at most `most`
//! influences: of all subsets, each solved as if weights could be negative, the best without one.
template <int Dim>
Eigen::VectorXd nearest_row(const Eigen::MatrixXd& metric, const PointList<Dim>& control_points,
                            const Vector<Dim>& point, const Eigen::VectorXd& target, Index most) {
  const auto n = static_cast<int>(control_points.cols());
  Eigen::VectorXd best;
  double least = std::numeric_limits<double>::infinity();
  for (int subset = 1; subset < (1 << n); ++subset) {
    std::vector<int> support;
    for (int i = 0; i < n; ++i) {
      if ((subset >> i) & 1) support.push_back(i);
    }
    const auto count = static_cast<Index>(support.size());
    if (count > most) continue;
    Eigen::MatrixXd system = Eigen::MatrixXd::Zero(count + Dim + 1, count + Dim + 1);
    system.topLeftCorner(count, count) = metric(support, support);
    system.block(count, 0, 1, count).setOnes();
    system.block(count + 1, 0, Dim, count) = control_points(Eigen::all, support);
    system.topRightCorner(count, Dim + 1) = system.bottomLeftCorner(Dim + 1, count).transpose();
    Eigen::VectorXd right(count + Dim + 1);
    right << (metric * target)(support), 1, point;
    const Eigen::VectorXd solution = least_squares(system, right);
    if (!((system * solution - right).norm() <= 1e-9)) continue;  // not in the hull of these
    if (solution.head(count).minCoeff() < -1e-12) continue;
    Eigen::VectorXd weights = Eigen::VectorXd::Zero(n);
    weights(support) = solution.head(count);
    const double cost = (weights - target).dot(metric * (weights - target));
    if (cost < least) {
      least = cost;
      best = weights;
    }
  }
  return best;
}

//! Expects w >= 0, sum w = 1, sum w c = x and few influences.
template <int Dim>
void expect_sparse_coordinates(const PointList<Dim>& control_points, const PointList<Dim>& points,
                               const WeightMatrix& weights, Index most) {
  const double size = bounding_box_diagonal<Dim>(control_points);
  ASSERT_EQ(weights.cols(), points.cols());
  for (Eigen::Index v = 0; v < points.cols(); ++v) {
    const auto column = weights.col(v);
    EXPECT_GE(column.minCoeff(), 0) << v;
    EXPECT_NEAR(column.sum(), 1, 1e-13) << v;
    // Far from the origin rounding may have moved the point off the hull by more.
    const PointList<Dim> offsets = control_points.colwise() - points.col(v);
    const double rounding = 4 * std::numeric_limits<double>::epsilon() * points.col(v).norm();
    EXPECT_LE((offsets * column).norm(), 1e-13 * size + rounding) << v;
    EXPECT_LE((column.array() != 0).count(), most) << v;
  }
}

}  // namespace flbc::testing
