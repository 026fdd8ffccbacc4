// SPDX-License-Identifier: BSD-3-Clause
// The reach of control points: a factor of their functions phi, in all ways to solve.
#include "flbc/quality.h"
#include "flbc/report.h"
#include "support/refined_sample.h"
#include "support/solver_options.h"

namespace flbc::testing {
namespace {

constexpr Method kMethods[] = {Method::kWeights, Method::kGradient, Method::kPaper,
                               Method::kLbc2014};

// Different for all control points.
std::vector<double> some_reach(Index n) {
  std::vector<double> reach;
  for (Index i = 0; i < n; ++i) reach.push_back(std::pow(2.0, 2 - (3 * i) % 5));
  return reach;
}

// phi of the default options, divided here.
template <int Dim>
LbcProblem<Dim> divided_problem(const Sample<Dim>& sample, const std::vector<double>& reach) {
  auto problem = smooth_problem(sample);
  Eigen::MatrixXd phi = problem.phi.dense();
  for (Index i = 0; i < phi.rows(); ++i) phi.row(i) /= reach[i];
  problem.phi = WeightFunctions(phi);
  return problem;
}

// The mean of the weights of a control point over the vertices.
double mean_weight(const Solution& solution, Index i) {
  return solution.weights.dense().row(i).mean();
}

TEST_IN_2D_AND_3D(ReachTest, OnesChangeNothing) {
  const auto sample = refined_sample<Dim>(Shape::kCorner, 3);
  for (const auto method : kMethods) {
    SCOPED_TRACE(name_of(method));
    SolverOptions options{method};
    options.max_iterations = 40;
    const auto free = solve(sample.cage, sample.mesh, options);
    options.reach.assign(sample.cage.size(), 1);
    EXPECT_EQ(solve(sample.cage, sample.mesh, options).weights.dense(), free.weights.dense());
    options.reach = some_reach(sample.cage.size());
    EXPECT_GT(squared_difference(solve(sample.cage, sample.mesh, options), free), 1e-6);
  }
}

// A bound that has nothing to do with the iteration is tight for phi divided by the test.
TEST_IN_2D_AND_3D(ReachTest, WeightsAreProvedOptimal) {
  const auto sample = make_sample<Dim>(Shape::kBox, Dim == 2 ? 4 : 3, 0.2);
  SolverOptions options;
  options.reach = some_reach(sample.cage.size());
  const auto problem = divided_problem(sample, options.reach);
  options = many_iterations(3000, options);
  options.certify = true;
  const auto [weights, report] = solve(sample.cage, sample.mesh, options);
  const double own =
      testing::objective(problem.mesh, weights.dense(), problem.phi.dense(), problem.smoothness);
  EXPECT_NEAR(report.objective * std::pow(problem.scale, Dim - 1), own, 1e-9 * own);
  EXPECT_LT(report.certificate.relative_gap, 1e-5);
}

// Problems made before, given phi, and multilevel starts have one optimum.
TEST_IN_2D_AND_3D(ReachTest, EveryWayToSolveAgrees) {
  const auto sample = refined_sample<Dim>(Shape::kCorner, Dim == 2 ? 6 : 3);
  SolverOptions options;
  options.distances = Distances::kExact;
  options.reach = some_reach(sample.cage.size());
  const auto divided = divided_problem(sample, options.reach);
  const auto optimum = solve(divided, many_iterations(2000));
  const auto expect_optimal = [&](const char* what, const Solution& solution) {
    SCOPED_TRACE(what);
    EXPECT_LT(squared_difference(solution, optimum), 2e-6);
    const double own = objective(divided, solution.weights);
    EXPECT_NEAR(solution.report.objective * std::pow(divided.scale, Dim - 1), own, 1e-9 * own);
  };
  solve_in_every_way(sample, options, expect_optimal);
}

TEST_IN_2D_AND_3D(ReachTest, ALargerFactorExtendsWeights) {
  const auto sample = make_sample<Dim>(Shape::kCorner, Dim == 2 ? 8 : 4, 0.2);
  for (const auto method : {Method::kWeights, Method::kGradient}) {
    SCOPED_TRACE(name_of(method));
    double before = 0;
    for (const double factor : {1.0 / 16, 0.5, 4.0, 16.0}) {
      SolverOptions options{method};
      options.reach.assign(sample.cage.size(), 1);
      options.reach[2] = factor;
      const double mean = mean_weight(solve(sample.cage, sample.mesh, options), 2);
      EXPECT_GT(mean, before) << factor;
      before = mean;
    }
  }
}

TEST(ReachTest, WrongFactorsAreRefused) {
  const auto sample = make_sample<2>(Shape::kBox, 3);
  const auto problem = smooth_problem(sample);
  Solver<2> solver(sample.cage, sample.mesh);
  const auto refused = [&](const std::vector<double>& reach, const std::string& words) {
    SolverOptions options;
    options.reach = reach;
    const auto expect = [&](auto&& action) { expect_refused<OptionError>(words, action); };
    expect([&] { solve(sample.cage, sample.mesh, options); });
    expect([&] { solve(problem, options); });
    expect([&] { solver.set_options(options); });
    expect([&] { Solver<2>(sample.cage, sample.mesh, options); });
  };
  refused({1, 1, 0, 1}, "reach of control point 2 must be in [1/16, 16], not 0; choose a factor");
  refused({1, 17, 1, 1}, "reach of control point 1 must be in [1/16, 16], not 17");
  refused({std::nan(""), 1, 1, 1}, "reach of control point 0 must be in [1/16, 16], not nan");
  refused({1, 1}, "reach needs a factor for each of the 4 control points, not 2");
}

}  // namespace
}  // namespace flbc::testing
