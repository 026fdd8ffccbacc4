// SPDX-License-Identifier: BSD-3-Clause
// A solver that resumes from where it stopped, and penalties in units of the cage.
#include "flbc/published_penalty.h"
#include "flbc/solver.h"
#include "support/fine_cages.h"
#include "support/many_iterations.h"
#include "support/test.h"

namespace flbc::testing {
namespace {

bool same_bits(const Solution& a, const Solution& b) {
  return a.weights == b.weights;
}

TEST_IN_2D_AND_3D(ContinuedSolveTest, TheFirstSolveIsTheOneOffFunction) {
  const auto sample = make_sample<Dim>(Shape::kCorner, 4, 0.2);
  for (const auto method : {Method::kValue, Method::kGradient, Method::kPaper, Method::kLbc2014}) {
    SCOPED_TRACE(static_cast<int>(method));
    SolverOptions options;
    options.method = method;
    options.max_iterations = 40;
    const auto expected = solve(sample.cage, sample.mesh, options);
    Solver<Dim> solver(sample.cage, sample.mesh, options);
    EXPECT_EQ(solver.solution().weights.dense().size(), 0);
    const auto& solution = solver.solve();
    EXPECT_TRUE(same_bits(solution, expected));
    EXPECT_EQ(solution.report.iterations, expected.report.iterations);
    EXPECT_EQ(solution.report.penalty, expected.report.penalty);
    EXPECT_EQ(solution.report.objective, expected.report.objective);
    EXPECT_GT(solution.report.seconds.setup, 0);
    solver.restart();
    EXPECT_TRUE(same_bits(solver.solve(), expected));
    EXPECT_EQ(solver.solution().report.seconds.setup, 0);
  }
}

TEST_IN_2D_AND_3D(ContinuedSolveTest, ARunInPartsIsOneInOnePiece) {
  const auto sample = make_sample<Dim>(Shape::kRing, 3, 0.2);
  for (const auto method : {Method::kValue, Method::kLbc2014, Method::kGradient, Method::kPaper}) {
    for (const auto precision : {Precision::kSingle, Precision::kDouble}) {
      SCOPED_TRACE(static_cast<int>(method));
      SolverOptions options;
      options.method = method;
      options.precision = precision;
      options.penalty = published_penalty(sample.cage, sample.mesh, method, 100);
      options.tolerance = 1e-20;
      options.max_iterations = 40;
      const auto whole = solve(sample.cage, sample.mesh, options);
      options.max_iterations = 25;
      Solver<Dim> solver(sample.cage, sample.mesh, options);
      EXPECT_FALSE(same_bits(solver.solve(), whole));
      options.max_iterations = 15;
      solver.set_options(options);
      EXPECT_TRUE(same_bits(solver.solve(), whole));
      EXPECT_EQ(solver.solution().report.iterations, 15);
    }
  }
}

// A run that is cut, or that ends by its limit, is a part of the whole run: the same weights and
// the same memory, whatever adapts on the way.
TEST_IN_2D_AND_3D(ContinuedSolveTest, ACutRunIsAPartOfTheWhole) {
  constexpr int kAll = 520;
  const auto sample = with_fine_cage<Dim>(Shape::kCorner, 2, Dim == 2 ? 8 : 4);
  for (const auto active_set : {ActiveSet::kOff, ActiveSet::kOn}) {
    SolverOptions options;
    options.active_set = active_set;
    options.tolerance = 1e-20;
    const auto limited = [&](int limit) {
      options.max_iterations = limit;
      return solve(sample.cage, sample.mesh, options);
    };
    const auto whole = limited(kAll);
    ASSERT_EQ(whole.report.iterations, kAll);
    EXPECT_EQ(whole.report.active_set.density < 1, active_set == ActiveSet::kOn);
    for (const int cut : {1, 20, 99, 100, 480, 499, 500}) {
      SCOPED_TRACE(cut);
      const auto first = limited(cut);
      EXPECT_EQ(first.report.state_scalars_per_cell, limited(1).report.state_scalars_per_cell);
      Solver<Dim> solver(sample.cage, sample.mesh, options);
      options.max_iterations = cut;
      solver.set_options(options);
      EXPECT_TRUE(same_bits(solver.solve(), first));
      EXPECT_EQ(solver.solution().report.penalty, first.report.penalty);
      options.max_iterations = kAll - cut;
      solver.set_options(options);
      EXPECT_TRUE(same_bits(solver.solve(), whole));
      EXPECT_EQ(solver.solution().report.iterations, kAll - cut);
      EXPECT_EQ(solver.solution().report.penalty, whole.report.penalty);
      EXPECT_EQ(solver.solution().report.active_set.growths, whole.report.active_set.growths);
    }
  }
}

// The default gap does not make a run leave the active set.
TEST_IN_2D_AND_3D(ContinuedSolveTest, StaysOnTheActiveSetWithDefaultTolerances) {
  const auto sample = with_fine_cage<Dim>(Shape::kCorner, 2, Dim == 2 ? 8 : 4);
  SolverOptions options;
  options.active_set = ActiveSet::kOn;
  for (const int limit : {1, 50, 100, 499, 600}) {
    options.max_iterations = limit;
    const auto report = solve(sample.cage, sample.mesh, options).report;
    EXPECT_LT(report.active_set.density, 1) << limit;
    EXPECT_LE(report.iterations, limit);
  }
}

// Also if weights beyond the border matter only for the second tolerance.
TEST_IN_2D_AND_3D(ContinuedSolveTest, ASmallerToleranceExtendsTheActiveSet) {
  const auto problem_sample = with_fine_cage<Dim>(Shape::kCorner, 2, Dim == 2 ? 8 : 4);
  const auto& [cage, mesh] = std::tie(problem_sample.cage, problem_sample.mesh);
  SolverOptions options;
  options.precision = Precision::kDouble;
  options.active_set = ActiveSet::kOff;
  options.tolerance = 1e-12;
  const auto optimum = solve(cage, mesh, options);
  options.active_set = ActiveSet::kOn;
  options.tolerance = 1e-6;
  Solver<Dim> solver(cage, mesh, options);
  solver.solve();
  options.tolerance = 1e-10;
  solver.set_options(options);
  const auto& solution = solver.solve();
  EXPECT_EQ(solution.report.status, SolveStatus::kConverged);
  EXPECT_LT(mean_squared_difference(mesh, solution.weights.dense(), optimum.weights.dense()),
            2e-10);
}

TEST_IN_2D_AND_3D(ContinuedSolveTest, ASmallerToleranceNeedsOnlyTheIterationsThatAreMissing) {
  const auto sample = make_sample<Dim>(Shape::kCorner, Dim == 2 ? 14 : 5, 0.2);
  SolverOptions options;
  options.tolerance = 1e-4;
  Solver<Dim> solver(sample.cage, sample.mesh, options);
  EXPECT_EQ(solver.solve().report.status, SolveStatus::kConverged);
  options.tolerance = 1e-6;
  solver.set_options(options);
  const auto& fine = solver.solve();
  const auto cold = solve(sample.cage, sample.mesh, options);
  EXPECT_EQ(fine.report.status, SolveStatus::kConverged);
  EXPECT_LT(fine.report.iterations, cold.report.iterations);
  EXPECT_LT(mean_squared_difference(sample.mesh, fine.weights.dense(), cold.weights.dense()), 4e-6);
}

TEST_IN_2D_AND_3D(ContinuedSolveTest, ContinuesOnTheActiveSet) {
  const auto sample = make_sample<Dim>(Shape::kCorner, Dim == 2 ? 14 : 5, 0.2);
  SolverOptions options;
  options.active_set = ActiveSet::kOn;
  options.tolerance = 1e-4;
  options.gap = 0;
  Solver<Dim> solver(sample.cage, sample.mesh, options);
  const auto first = solve(sample.cage, sample.mesh, options);
  EXPECT_LT(first.report.active_set.density, 1);
  EXPECT_TRUE(same_bits(solver.solve(), first));

  options.tolerance = 1e-6;
  solver.set_options(options);
  const auto fine = solver.solve();
  EXPECT_EQ(fine.report.status, SolveStatus::kConverged);
  EXPECT_LT(fine.report.active_set.density, 1);
  EXPECT_LT(fine.report.iterations, solve(sample.cage, sample.mesh, options).report.iterations);
  const auto optimum = solve(sample.cage, sample.mesh, many_iterations(2000));
  EXPECT_LT(mean_squared_difference(sample.mesh, fine.weights.dense(), optimum.weights.dense()),
            2e-6);

  options.active_set = ActiveSet::kOff;
  options.certify = true;
  solver.set_options(options);
  const auto& certified = solver.solve().report;
  EXPECT_LE(certified.certificate.lower_bound, optimum.report.objective * (1 + 1e-9));
  EXPECT_LT(certified.certificate.relative_gap, 0.02);
  EXPECT_EQ(solver.solve().report.status, SolveStatus::kConverged);
  solver.restart();
  EXPECT_EQ(solver.solve().report.status, SolveStatus::kConverged);
}

TEST_IN_2D_AND_3D(ContinuedSolveTest, OptionsThatCannotChangeInARunStartAfresh) {
  const auto sample = make_sample<Dim>(Shape::kBox, 4, 0.2);
  SolverOptions options;
  options.max_iterations = 20;
  Solver<Dim> solver(sample.cage, sample.mesh, options);
  solver.solve();
  const auto afresh = [&](auto change) {
    change(options);
    solver.set_options(options);
    EXPECT_TRUE(same_bits(solver.solve(), solve(sample.cage, sample.mesh, options)));
  };
  afresh([](auto& o) { o.precision = Precision::kDouble; });
  afresh([](auto& o) { o.non_negative = NonNegative::kOff; });
  afresh([](auto& o) { o.penalty = 0.01; });
  afresh([](auto& o) { o.relaxation = 1.2; });
  afresh([](auto& o) { o.smoothness = 0.01; });
  afresh([](auto& o) { o.linear_solver = LinearSolver::kMultigrid; });
  afresh([](auto& o) { o.coarse_levels.coarsest = 20; });
  afresh([](auto& o) { o.coarse_to_fine = CoarseToFine::kOff; });
  afresh([](auto& o) { o.active_set = ActiveSet::kOn; });
  afresh([](auto& o) { o.method = Method::kGradient; });
  afresh([](auto& o) { o.penalty.reset(); });
}

TEST_IN_2D_AND_3D(ContinuedSolveTest, RefusedOptionsChangeNothing) {
  const auto sample = make_sample<Dim>(Shape::kBox, 4, 0.2);
  SolverOptions options;
  options.penalty = 0.02;
  options.tolerance = 1e-20;
  options.max_iterations = 20;
  Solver<Dim> solver(sample.cage, sample.mesh, options);
  solver.solve();
  auto refused = options;
  refused.phi = DistanceScheme::kLinear;
  EXPECT_THROW(solver.set_options(refused), OptionError);
  refused = options;
  refused.distances = Distances::kExact;
  EXPECT_THROW(solver.set_options(refused), OptionError);
  refused = options;
  refused.coarse_to_fine = CoarseToFine::kOn;
  EXPECT_THROW(solver.set_options(refused), OptionError);
  EXPECT_EQ(solver.options().phi, options.phi);
  EXPECT_EQ(solver.options().coarse_to_fine, options.coarse_to_fine);
  solver.solve();
  options.max_iterations = 40;
  EXPECT_TRUE(same_bits(solver.solution(), solve(sample.cage, sample.mesh, options)));
}

// A cage in metres and one in millimetres are solved alike by the same options.
TEST_IN_2D_AND_3D(ContinuedSolveTest, PenaltiesDoNotDependOnTheUnitOfLength) {
  const auto sample = make_sample<Dim>(Shape::kCorner, 4, 0.2);
  auto scaled = sample;
  scaled.cage.points *= 1024;
  scaled.mesh.points *= 1024;
  for (const auto method : {Method::kValue, Method::kLbc2014, Method::kGradient, Method::kPaper}) {
    SCOPED_TRACE(static_cast<int>(method));
    SolverOptions options;
    options.method = method;
    options.max_iterations = 30;
    options.penalty = published_penalty(sample.cage, sample.mesh, method, 10);
    EXPECT_NEAR(published_penalty(scaled.cage, scaled.mesh, method, 10), *options.penalty,
                1e-12 * *options.penalty);
    const auto one = solve(sample.cage, sample.mesh, options);
    const auto other = solve(scaled.cage, scaled.mesh, options);
    EXPECT_LT((one.weights.dense() - other.weights.dense()).cwiseAbs().maxCoeff(), 1e-6);
    EXPECT_NEAR(one.report.penalty, *options.penalty, 1e-12 * *options.penalty);
    EXPECT_NEAR(one.report.published_penalty, 10, 1e-11);
    EXPECT_NEAR(other.report.published_penalty, 10, 1e-11);
  }
}

// What a run reports can be asked for.
TEST_IN_2D_AND_3D(ContinuedSolveTest, TheDefaultPenaltyCanBeGiven) {
  const auto sample = make_sample<Dim>(Shape::kCorner, 4, 0.2);
  for (const auto method : {Method::kGradient, Method::kPaper}) {
    SolverOptions options;
    options.method = method;
    options.precision = Precision::kDouble;
    options.max_iterations = 30;
    const auto by_method = solve(sample.cage, sample.mesh, options);
    options.penalty = by_method.report.penalty;
    const auto given = solve(sample.cage, sample.mesh, options);
    EXPECT_LT((by_method.weights.dense() - given.weights.dense()).cwiseAbs().maxCoeff(), 1e-9);
  }
}

}  // namespace
}  // namespace flbc::testing
