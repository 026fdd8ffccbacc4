// SPDX-License-Identifier: BSD-3-Clause
// The energy of reduce_by_poisson() and how near its minimum it comes, by trying all supports.
#include "flbc/poses.h"
#include "sparsify/poisson/poisson_energy.h"
#include "sparsify/support_selection.h"
#include "support/poisson_problem.h"

namespace flbc::testing {
namespace {

TEST_IN_2D_AND_3D(PoissonOptimalityTest, TheCostIsWhatTheHeaderSays) {
  Numbers numbers(23);
  const PointList<Dim> control_points = numbers.matrix(Dim, 9, -1, 1);
  auto problem = problem_on_a_curve<Dim>(control_points, 12, 0.1);
  auto& edges = problem.edges;
  for (std::size_t e = 0; e < edges.ends.size(); ++e)
    edges.weights.push_back(numbers.uniform(1, 2));
  const auto after = problem.plain(at_most(Dim + 1));
  const auto length = [&](std::size_t e) {
    return (problem.points.col(edges.ends[e][0]) - problem.points.col(edges.ends[e][1])).norm();
  };
  double mean = 0;
  for (std::size_t e = 0; e < edges.ends.size(); ++e) {
    mean += length(e) / static_cast<double>(edges.ends.size());
  }
  const double reach = std::max(0.05 * bounding_box_diagonal<Dim>(problem.points), 5 * mean);
  const double unit = 0.1 * bounding_box_diagonal<Dim>(control_points);
  const auto mean_cost = [&](const std::vector<PointList<Dim>>& poses) {
    double sum = 0;
    for (const auto& pose : poses) {
      const PointList<Dim> moved = pose * (after - problem.weights);
      for (std::size_t e = 0; e < edges.ends.size(); ++e) {
        const auto a = moved.col(edges.ends[e][0]), b = moved.col(edges.ends[e][1]);
        sum += edges.weights[e] *
               ((a - b).squaredNorm() +
                length(e) * length(e) / 2 * (a.squaredNorm() + b.squaredNorm()) / (reach * reach));
      }
    }
    return sum / static_cast<double>(poses.size()) / (unit * unit);
  };
  const double expectation = problem.cost(after);
  const double sampled = mean_cost(independent_poses<Dim>(control_points, 4000)) +
                         mean_cost(smooth_poses<Dim>(control_points, 4000));
  EXPECT_NEAR(expectation, sampled, 0.05 * sampled);
  // Far away, too: only differences count.
  const std::vector<PointList<Dim>> poses{numbers.matrix(Dim, 9, -1, 1),
                                          numbers.matrix(Dim, 9, 99, 102)};
  const double given = mean_cost(poses);
  EXPECT_NEAR(problem.cost(after, poses), given + 0.1 * expectation, 1e-9 * given);
  EXPECT_EQ(problem.cost(problem.weights), 0);
}

// Checks the search of supports in a metric by trying all of them.
template <int Dim>
void expect_near_the_best(SupportSelection<Dim>& selection, const Eigen::MatrixXd& metric,
                          const PointList<Dim>& control_points) {
  constexpr double kNoBound = std::numeric_limits<double>::infinity();
  constexpr int kPoints = 40;
  const auto n = static_cast<Index>(control_points.cols());
  Numbers numbers(35);
  std::vector<Index> everyone;
  for (Index i = 0; i < n; ++i) everyone.push_back(i);
  int best = 0;
  for (int k = 0; k < kPoints; ++k) {
    const Vector<Dim> point = control_points * numbers.convex(n);
    const Eigen::VectorXd target = numbers.matrix(n, 1, -0.3, 0.6);
    selection.qp().aim_at(point) = metric * target;
    const double shift = target.dot(metric * target);
    const auto cost_of = [&](const Eigen::VectorXd& weights) {
      return (weights - target).dot(metric * (weights - target)) - shift;
    };
    // Without a limit the problem is convex: two ways to its minimum.
    const double least = cost_of(nearest_row<Dim>(metric, control_points, point, target, n));
    PointWeights weights;
    ASSERT_TRUE(selection.qp().solve(everyone, kNoBound, weights));
    EXPECT_NEAR(weights.cost, least, 1e-9);
    // With a limit, removing and exchanging come near it.
    const Index most = Dim + 2;
    const double limited = cost_of(nearest_row<Dim>(metric, control_points, point, target, most));
    ASSERT_TRUE(selection.reduce(most, kNoBound, weights));
    selection.exchange(most, 0, everyone, weights);
    EXPECT_LE(static_cast<Index>(weights.support.size()), most);
    EXPECT_GE(weights.cost, limited - 1e-9);
    best += weights.cost <= limited + 1e-7;
  }
  EXPECT_GE(best, 3 * kPoints / 4);
}

TEST_IN_2D_AND_3D(PoissonOptimalityTest, OnePointsWeightsAreNearTheBestInAnyMetric) {
  constexpr int kControls = 8;
  Numbers numbers(33);
  const PointList<Dim> control_points = numbers.matrix(Dim, kControls, -1, 1);
  const std::vector<PointList<Dim>> poses{numbers.matrix(Dim, kControls, -2, 2)};
  const auto matrix = pose_metric<Dim>(control_points, poses).matrix;
  SupportSelection<Dim> in_poses(Metric(matrix), control_points);
  expect_near_the_best<Dim>(in_poses, matrix, control_points);
  SupportSelection<Dim> euclidean(Metric(), control_points);
  expect_near_the_best<Dim>(euclidean, Eigen::MatrixXd::Identity(kControls, kControls),
                            control_points);
}

// Few numbers describe a pose: its metric differs from a multiple of the identity by a low rank.
TEST_IN_2D_AND_3D(PoissonOptimalityTest, AMetricOfFewPosesHasALowRank) {
  constexpr int kControls = 40;
  Numbers numbers(34);
  const PointList<Dim> control_points = numbers.matrix(Dim, kControls, -1, 1);
  std::vector<PointList<Dim>> poses;
  for (const int most : {0, 1, 3, kControls}) {
    while (static_cast<int>(poses.size()) < most) {
      poses.push_back(numbers.matrix(Dim, kControls, -2, 2));
    }
    const auto [identity, factor, matrix] = pose_metric<Dim>(control_points, poses);
    const Eigen::MatrixXd whole =
        identity * Eigen::MatrixXd::Identity(kControls, kControls) + factor.transpose() * factor;
    EXPECT_LT((whole - matrix).cwiseAbs().maxCoeff(), 1e-12 * matrix.maxCoeff());
    constexpr int kQuadratic = Dim * (Dim + 1) / 2;
    EXPECT_EQ(factor.rows(), std::min(kControls, Dim + kQuadratic + Dim * most));
  }
}

// The same problem in the identity as a special case and as a matrix.
TEST_IN_2D_AND_3D(PoissonOptimalityTest, TheIdentityIsAMetricLikeAnyOther) {
  constexpr int kControls = 20;
  Numbers numbers(36);
  const PointList<Dim> control_points = numbers.matrix(Dim, kControls, -1, 1);
  const Eigen::MatrixXd identity = Eigen::MatrixXd::Identity(kControls, kControls);
  SupportSelection<Dim> special(Metric(), control_points),
      general(Metric(identity), control_points);
  std::vector<Index> everyone;
  for (Index i = 0; i < kControls; ++i) everyone.push_back(i);
  for (int k = 0; k < 40; ++k) {
    const Vector<Dim> point = control_points * numbers.convex(kControls);
    const Eigen::VectorXd target = numbers.matrix(kControls, 1, -0.2, 0.3);
    PointWeights found[2];
    for (auto* selection : {&special, &general}) {
      auto& weights = found[selection == &general];
      selection->qp().aim_at(point) = target;
      constexpr double kNoBound = std::numeric_limits<double>::infinity();
      ASSERT_TRUE(selection->qp().solve(everyone, kNoBound, weights));
      ASSERT_TRUE(selection->reduce(Dim + 3, kNoBound, weights));
      selection->exchange(Dim + 3, 1e-9, everyone, weights);
    }
    EXPECT_EQ(found[0].support, found[1].support);
    EXPECT_NEAR(found[0].cost, found[1].cost, 1e-9);
  }
}

// Rows that another support would make better while all other rows stay as they are, and by how
// much. What counts is `noticeable`.
struct Gains {
  int rows = 0;
  double sum = 0;
};

template <int Dim>
Gains find_gains(const PoissonProblem<Dim>& problem, const WeightMatrix& weights, Index most,
                 double noticeable) {
  const auto metric = pose_metric<Dim>(problem.control_points, {}).matrix;
  const double cost = problem.cost(weights);
  Gains gains;
  for (Index a = 0; a < static_cast<Index>(weights.cols()); ++a) {
    // Neighbors pull a row toward their own changes; how stiffly it is held in all, pin included,
    // is what a change of this row alone costs.
    Eigen::VectorXd pull = Eigen::VectorXd::Zero(weights.rows());
    for (const auto& [b, c] : problem.edges.ends) {
      if (a == b || a == c) pull += (weights - problem.weights).col(a == b ? c : b);
    }
    WeightMatrix alone = problem.weights;
    alone(0, a) += 1;
    const double stiffness = problem.cost(alone) / metric(0, 0);
    const Eigen::VectorXd target = problem.weights.col(a) + pull / stiffness;
    WeightMatrix better = weights;
    better.col(a) =
        nearest_row<Dim>(metric, problem.control_points, problem.points.col(a), target, most);
    const double gain = cost - problem.cost(better);
    EXPECT_GE(gain, -1e-9 * cost) << a;  // the reference is correct
    gains.rows += gain > noticeable;
    gains.sum += gain;
  }
  return gains;
}

TEST_IN_2D_AND_3D(PoissonOptimalityTest, HardlyARowCouldBeBetterForItsNeighbours) {
  constexpr int kPoints = 60;
  Numbers numbers(34);
  const auto problem = problem_on_a_curve<Dim>(numbers.matrix(Dim, 8, -1, 1), kPoints, 0.2);
  for (const Index most : {Dim + 1, Dim + 2}) {
    SCOPED_TRACE(most);
    const auto plain = problem.plain(at_most(most));
    const double noticeable = 0.01 * problem.cost(plain) / kPoints;
    const auto left = find_gains<Dim>(problem, problem.reduce(at_most(most)), most, noticeable);
    const auto before = find_gains<Dim>(problem, plain, most, noticeable);
    EXPECT_LE(left.rows, kPoints / 10);
    EXPECT_LE(4 * left.rows, before.rows);
    EXPECT_LE(left.sum, 0.1 * before.sum);
  }
}

}  // namespace
}  // namespace flbc::testing
