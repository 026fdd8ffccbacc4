// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/sparsify.h"

#include "flbc/poses.h"
#include "support/poisson_problem.h"

namespace flbc::testing {
namespace {

TEST_IN_2D_AND_3D(PoissonReductionTest, KeepsTheConstraintsWhateverComes) {
  Numbers numbers(28);
  for (const auto& [name, control_points] : awkward_control_points<Dim>()) {
    SCOPED_TRACE(name);
    auto problem = problem_on_a_curve<Dim>(control_points, 40, 0.3);
    const auto n = control_points.cols();
    // Every other row has negative weights, and does not reproduce.
    for (int v = 0; v < 40; v += 2) problem.weights.col(v) += numbers.matrix(n, 1, -0.2, 0.2);
    const double size = bounding_box_diagonal<Dim>(control_points);
    const PointList<Dim> pose = control_points + size * numbers.matrix(Dim, n, -1, 1);
    for (const Index most : {Dim + 1, Dim + 3}) {
      SCOPED_TRACE(most);
      const auto plain = problem.plain(at_most(most));
      for (const auto& poses : std::vector<std::vector<PointList<Dim>>>{{}, {pose}}) {
        const auto sparse = problem.reduce(at_most(most), poses);
        expect_sparse_coordinates<Dim>(control_points, problem.points, sparse, most);
        EXPECT_LE(problem.cost(sparse, poses), problem.cost(plain, poses));
      }
    }
    const auto dropped = problem.reduce(at_most(8, 0.05));
    expect_sparse_coordinates<Dim>(control_points, problem.points, dropped, 8);
  }
}

TEST_IN_2D_AND_3D(PoissonReductionTest, SmallerErrorsOfGradientsThanPointByPoint) {
  Numbers numbers(29);
  const PointList<Dim> control_points = numbers.matrix(Dim, 14, -1, 1);
  const auto on_a_curve = problem_on_a_curve<Dim>(control_points, 300, 0);
  const auto on_a_mesh = problem_on_a_mesh<Dim>();
  for (const auto* problem : {&on_a_curve, &on_a_mesh}) {
    // On the mesh most neighbors lie on the cage and stay.
    const double part = problem == &on_a_curve ? 0.7 : 0.97;
    const auto independent = independent_poses<Dim>(problem->control_points, 20);
    const auto smooth = smooth_poses<Dim>(problem->control_points, 20);
    for (const Index most : {Dim + 1, Dim + 2, Dim + 3}) {
      SCOPED_TRACE(most);
      const auto plain = problem->plain(at_most(most));
      const auto sparse = problem->reduce(at_most(most));
      expect_sparse_coordinates<Dim>(problem->control_points, problem->points, sparse, most);
      EXPECT_LT(problem->cost(sparse), part * problem->cost(plain));
      EXPECT_LT(problem->error(sparse, independent).rms, problem->error(plain, independent).rms);
      EXPECT_LT(problem->error(sparse, smooth).rms, problem->error(plain, smooth).rms);
    }
  }
}

TEST_IN_2D_AND_3D(PoissonReductionTest, GivenPosesCount) {
  Numbers numbers(27);
  const auto problem = problem_on_a_curve<Dim>(numbers.matrix(Dim, 14, -1, 1), 200, 0.05);
  std::vector<PointList<Dim>> poses{problem.control_points, problem.control_points};
  for (auto& pose : poses) pose += numbers.matrix(Dim, 14, -1, 1);
  const auto with = problem.reduce(at_most(Dim + 3), poses);
  const auto without = problem.reduce(at_most(Dim + 3));
  EXPECT_LT(problem.cost(with, poses), 0.7 * problem.cost(without, poses));
  EXPECT_LT(problem.error(with, poses).rms, 0.9 * problem.error(without, poses).rms);
}

TEST_IN_2D_AND_3D(PoissonReductionTest, WhatIsSparseStays) {
  auto problem = problem_on_a_mesh<Dim>();
  const auto sparse = problem.reduce(at_most(Dim + 1));
  EXPECT_NE(sparse, problem.weights);
  problem.weights = sparse;
  EXPECT_EQ(problem.reduce(at_most(Dim + 1)), sparse);
  EXPECT_EQ(problem.reduce(at_most(Dim + 5)), sparse);
}

TEST_IN_2D_AND_3D(PoissonReductionTest, PointsOnTheCageStayWhateverTheirNeighboursDo) {
  Numbers numbers(36);
  auto problem = problem_on_a_curve<Dim>(numbers.matrix(Dim, 12, -1, 1), 120, 0.1);
  for (int v = 0; v < 120; v += 6) {
    auto row = problem.weights.col(v);
    const Eigen::VectorXd before = row;
    row.setZero();
    for (int k = 0; k < Dim; ++k) row[(v + 5 * k) % 12] = before[(v + 5 * k) % 12];
    row /= row.sum();
  }
  problem.points = problem.control_points * problem.weights;
  const auto sparse = problem.reduce(at_most(Dim + 1));
  for (int v = 0; v < 120; ++v) EXPECT_EQ(sparse.col(v) == problem.weights.col(v), v % 6 == 0) << v;
}

// It starts with one influence more than allowed, where these rows cost nothing.
TEST_IN_2D_AND_3D(PoissonReductionTest, OneInfluenceTooManyIsRemoved) {
  Numbers numbers(35);
  auto problem = problem_on_a_curve<Dim>(numbers.matrix(Dim, 12, -1, 1), 40, 0.1);
  problem.weights = problem.plain(at_most(Dim + 3));
  const auto sparse = problem.reduce(at_most(Dim + 2));
  expect_sparse_coordinates<Dim>(problem.control_points, problem.points, sparse, Dim + 2);
}

TEST_IN_2D_AND_3D(PoissonReductionTest, PointsWithoutEdgesAreTakenOneByOne) {
  Numbers numbers(30);
  auto problem = problem_on_a_curve<Dim>(numbers.matrix(Dim, 12, -1, 1), 80, 0.1);
  const auto plain = problem.plain(at_most(Dim + 2));
  auto& ends = problem.edges.ends;
  ends.erase(std::remove_if(ends.begin(), ends.end(),
                            [](const auto& edge) { return std::max(edge[0], edge[1]) >= 50; }),
             ends.end());
  const auto sparse = problem.reduce(at_most(Dim + 2));
  EXPECT_EQ(sparse.rightCols(30), plain.rightCols(30));
  EXPECT_NE(sparse, plain);
  ends.clear();
  EXPECT_EQ(problem.reduce(at_most(Dim + 2)), plain);
}

TEST_IN_2D_AND_3D(PoissonReductionTest, NothingTearsWhereVerticesAreDoubled) {
  Numbers numbers(31);
  const auto problem = problem_on_a_curve<Dim>(numbers.matrix(Dim, 12, -1, 1), 80, 0.1);
  // Every edge has separate ends.
  auto loose = problem;
  std::vector<Index> origin;
  for (auto& edge : loose.edges.ends) {
    for (Index& end : edge) {
      origin.push_back(end);
      end = static_cast<Index>(origin.size()) - 1;
    }
  }
  loose.points = problem.points(Eigen::all, origin);
  loose.weights = problem.weights(Eigen::all, origin);
  const auto sparse = loose.reduce(at_most(Dim + 2));
  WeightMatrix welded(12, 80);
  for (std::size_t k = 0; k < origin.size(); ++k) welded.col(origin[k]) = sparse.col(k);
  EXPECT_EQ(sparse, welded(Eigen::all, origin));
  EXPECT_LT((welded - problem.reduce(at_most(Dim + 2))).cwiseAbs().maxCoeff(), 1e-9);
  EXPECT_LT(problem.cost(welded), 0.8 * problem.cost(problem.plain(at_most(Dim + 2))));
}

TEST_IN_2D_AND_3D(PoissonReductionTest, NewcomersObeyTheThreshold) {
  Numbers numbers(25);
  const auto problem = problem_on_a_curve<Dim>(numbers.matrix(Dim, 14, -1, 1), 60, 0.05);
  constexpr double kThreshold = 0.06;
  for (const Index most : {Index{14}, Index{Dim + 3}}) {
    const auto plain = problem.plain(at_most(most, kThreshold));
    // Where no weights above the threshold reproduce a point, others may be kept.
    const auto more = problem.plain(at_most(std::min<Index>(14, most + 1), kThreshold));
    const auto sparse = problem.reduce(at_most(most, kThreshold));
    EXPECT_LT(problem.cost(sparse), problem.cost(plain));
    for (Eigen::Index v = 0; v < 60; ++v) {
      for (Eigen::Index i = 0; i < 14; ++i) {
        if (sparse(i, v) == 0 || plain(i, v) > 0 || more(i, v) > 0) continue;
        EXPECT_GE(problem.weights(i, v), kThreshold) << i << " " << v;
      }
    }
  }
}

// Turned by a right angle, because bounding_box_diagonal() is that of a box along the axes.
TEST_IN_2D_AND_3D(PoissonReductionTest, SizePlaceAndAxesDoNotMatter) {
  Numbers numbers(32);
  const auto problem = problem_on_a_curve<Dim>(numbers.matrix(Dim, 12, -1, 1), 80, 0.1);
  auto moved = problem;
  Eigen::Matrix<double, Dim, Dim> turn = Eigen::Matrix<double, Dim, Dim>::Identity();
  turn.template topLeftCorner<2, 2>() << 0, -1, 1, 0;
  for (auto* points : {&moved.control_points, &moved.points}) {
    *points = (37 * (turn * *points)).colwise() + Vector<Dim>::Constant(50);
  }
  const auto sparse = problem.reduce(at_most(Dim + 2));
  const auto there = moved.reduce(at_most(Dim + 2));
  EXPECT_NEAR(moved.cost(there), problem.cost(sparse), 1e-6 * problem.cost(sparse));
  EXPECT_LT((there - sparse).cwiseAbs().maxCoeff(), 1e-6);
}

TEST_IN_2D_AND_3D(PoissonReductionTest, TheThreadsDoNotMatter) {
  Numbers numbers(26);
  const auto problem = problem_on_a_curve<Dim>(numbers.matrix(Dim, 20, -1, 1), 500, 0.1);
  EXPECT_NE(problem.reduce(at_most(Dim + 2)), problem.plain(at_most(Dim + 2)));
  expect_same_for_any_threads([&] { return problem.reduce(at_most(Dim + 2)); });
}

TEST_IN_2D_AND_3D(PoissonReductionTest, TellsHowFarItIs) {
  Numbers numbers(26);
  const auto problem = problem_on_a_curve<Dim>(numbers.matrix(Dim, 20, -1, 1), 500, 0.1);
  std::vector<double> reported;
  auto options = at_most(Dim + 2);
  options.progress = [&](double done) { reported.push_back(done); };
  const ThreadScope scope(1);
  EXPECT_EQ(problem.reduce(options), problem.reduce(at_most(Dim + 2)));
  ASSERT_FALSE(reported.empty());
  EXPECT_TRUE(std::is_sorted(reported.begin(), reported.end()));
  EXPECT_LT(reported.front(), 0.01);
  EXPECT_GT(reported.back(), 0.7);
  EXPECT_LE(reported.back(), 1);
}

TEST_IN_2D_AND_3D(PoissonReductionTest, RefusesWhatCannotBe) {
  Numbers numbers(27);
  const auto problem = problem_on_a_curve<Dim>(numbers.matrix(Dim, 10, -1, 1), 8, 0.1);
  EXPECT_NO_THROW(problem.reduce(at_most(Dim + 1)));
  expect_error<OptionError>([&] { problem.reduce(at_most(Dim)); }, {"fewer cannot reproduce"});
  auto wrong = problem;
  wrong.edges.ends.push_back({2, 8});
  expect_error<InputError>([&] { wrong.reduce(at_most(8)); }, {"ends at point 8"});
  expect_error<InputError>([&] { wrong.cost(problem.weights); }, {"ends at point 8"});
  wrong = problem;
  wrong.weights = numbers.matrix(9, 8, 0, 1);
  expect_error<InputError>([&] { wrong.reduce(at_most(8)); }, {"9 control points do not match"});
  expect_error<InputError>([&] { wrong.cost(problem.weights); }, {"9 control points do not match"});
  expect_error<InputError>([&] { problem.cost(wrong.weights); }, {"9 control points do not match"});
  wrong = problem;
  wrong.points.col(3).setConstant(9);
  expect_error<InputError>([&] { wrong.reduce(at_most(8)); }, {"point 3 at (9, 9"});
  std::vector<PointList<Dim>> poses{problem.control_points, problem.control_points.leftCols(9)};
  expect_error<InputError>([&] { problem.reduce(at_most(8), poses); }, {"pose 1 has 9"});
  poses[1] = problem.control_points;
  poses[1](0, 0) = std::nan("");
  expect_error<InputError>([&] { problem.reduce(at_most(8), poses); }, {"pose 1", "not finite"});
}

}  // namespace
}  // namespace flbc::testing
