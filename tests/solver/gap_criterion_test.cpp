// SPDX-License-Identifier: BSD-3-Clause
// Runs that end because their weights are proved to be near the optimum.
#include "flbc/names.h"
#include "flbc/solver.h"
#include "solver/run/run.h"
#include "support/solver_models.h"
#include "support/test.h"

namespace flbc::testing {
namespace {

SolverOptions never_by_tolerance(double gap) {
  SolverOptions options;
  options.tolerance = 1e-30;
  options.gap = gap;
  options.max_iterations = 900;
  return options;
}

TEST_IN_2D_AND_3D(GapCriterionTest, RoundCagesConvergeWhereTheirToleranceIsFar) {
  // Weights are nearly undetermined: every function is a little of all.
  Cage<Dim> cage;
  if constexpr (Dim == 2) {
    cage = regular_polygon(40);
  } else {
    cage = round_cage(4);
  }
  const auto mesh = mesh_of(cage, 1500);
  const auto solution = solve(cage, mesh);
  EXPECT_EQ(solution.report.status, SolveStatus::kConverged);
  EXPECT_EQ(solution.report.criterion, Criterion::kGap);
  EXPECT_GE(solution.report.iterations, 500);
  EXPECT_LE(solution.report.certificate.relative_gap, 1e-3);
  EXPECT_GT(solution.report.relative_primal_residual, 1);
  EXPECT_NEAR(solution.report.certificate.objective, solution.report.objective,
              1e-9 * solution.report.objective);
  EXPECT_GE(solution.weights.dense().minCoeff(), 0);
  SolverOptions without;
  without.gap = 0;
  without.max_iterations = 3 * solution.report.iterations;
  const auto report = solve(cage, mesh, without).report;
  EXPECT_NE(report.criterion, Criterion::kGap);
  EXPECT_EQ(report.certificate.objective > 0, report.criterion == Criterion::kTolerance);
  EXPECT_GT(report.iterations, solution.report.iterations);
  EXPECT_LE(solution.report.objective, (1 + 1e-3) * report.objective);
}

TEST_IN_2D_AND_3D(GapCriterionTest, EndsAllMethodsThatHaveDuals) {
  const auto sample = make_sample<Dim>(Shape::kCorner, 3, 0.2);
  for (const auto method : {Method::kValue, Method::kLbc2014, Method::kGradient}) {
    SCOPED_TRACE(name_of(method));
    // The iteration of kGradient does not know that weights are not negative.
    const double gap = method == Method::kGradient ? 0.9 : 0.2;
    auto options = never_by_tolerance(gap);
    options.method = method;
    const auto solution = solve(sample.cage, sample.mesh, options);
    EXPECT_EQ(solution.report.criterion, Criterion::kGap);
    EXPECT_EQ(solution.report.iterations, 500);
    EXPECT_LE(solution.report.certificate.relative_gap, gap);
    options.gap = 0;
    options.max_iterations = 500;
    const auto plain = solve(sample.cage, sample.mesh, options);
    EXPECT_EQ(plain.report.status, SolveStatus::kIterationLimit);
    EXPECT_TRUE((plain.weights.dense().array() == solution.weights.dense().array()).all());
  }
}

TEST_IN_2D_AND_3D(GapCriterionTest, ASmallerGapTakesLongerAndTheLastIterationIsLookedAt) {
  const auto sample = make_sample<Dim>(Shape::kRing, 3, 0.2);
  auto options = never_by_tolerance(1e-12);
  EXPECT_EQ(solve(sample.cage, sample.mesh, options).report.status, SolveStatus::kIterationLimit);
  options.max_iterations = 590;  // between the first certificate and the second
  options.certify = true;
  const double gap = solve(sample.cage, sample.mesh, options).report.certificate.relative_gap;
  options.max_iterations = 500;
  ASSERT_LT(gap, solve(sample.cage, sample.mesh, options).report.certificate.relative_gap);
  options.gap = 1.0001 * gap;
  options.max_iterations = 590;
  const auto report = solve(sample.cage, sample.mesh, options).report;
  EXPECT_EQ(report.criterion, Criterion::kGap);
  EXPECT_EQ(report.iterations, 590);
}

TEST_IN_2D_AND_3D(GapCriterionTest, HoldsForSolversThatContinueAndForMovedCages) {
  const auto sample = make_sample<Dim>(Shape::kCorner, 3, 0.2);
  const auto options = never_by_tolerance(0.2);
  const auto once = solve(sample.cage, sample.mesh, options);
  Solver<Dim> solver(sample.cage, sample.mesh, options);
  EXPECT_TRUE((solver.solve().weights.dense().array() == once.weights.dense().array()).all());
  EXPECT_EQ(solver.solution().report.criterion, Criterion::kGap);
  EXPECT_EQ(solver.solve().report.criterion, Criterion::kGap);  // resumed
  EXPECT_EQ(solver.move(sample.cage.points).report.criterion, Criterion::kGap);
}

// An iteration whose certificate is given.
struct Certified : Iteration<2> {
  double gap = 0;

  void start(const Start<2>&) override {}
  Step iterate(int, int, bool) override { return {}; }
  Weights weights() const override { return {WeightMatrix::Zero(3, 1), {}}; }
  void read_weights(Index, double*) const override {}
  Certificate certify(const WeightMatrix&, Proof*) const override { return {1, 1 - gap, gap, {}}; }
  void describe(SolveReport&) const override {}
};

TEST(GapCriterion, TheDefaultOneWaitsForWeightsThatStillMoveFar) {
  const auto ends = [](std::optional<double> wanted, double gap, double error) {
    Certified iteration;
    iteration.gap = gap;
    SolverOptions options;
    options.gap = wanted;
    return GapCriterion().is_met(plan::settings_of(options), iteration, 500, false, error);
  };
  EXPECT_TRUE(ends({}, 9e-4, 5));
  EXPECT_FALSE(ends({}, 9e-4, 50));
  EXPECT_FALSE(ends({}, 2e-3, 5));
  // A flat optimum: the weights may never settle.
  EXPECT_TRUE(ends({}, 9e-5, 1e6));
  // A gap that somebody asks for is all that counts, also if it is the default one.
  for (const double wanted : {1e-2, 1.0001e-3, 1e-3, 1e-5}) {
    EXPECT_TRUE(ends(wanted, 0.9 * wanted, 1e6));
    EXPECT_FALSE(ends(wanted, 1.1 * wanted, 1));
  }
}

TEST(GapOption, ATighterToleranceIsMeantAsItIsGiven) {
  SolverOptions options;
  EXPECT_EQ(*resolve(options).gap, 1e-3);
  EXPECT_EQ(*resolve(resolve(options)).gap, 1e-3);
  options.method = Method::kGradient;
  EXPECT_EQ(*resolve(options).gap, 1e-3);
  for (const auto method : {Method::kPaper, Method::kLbc2014}) {
    options.method = method;
    EXPECT_EQ(*resolve(options).gap, 0);
  }
  options = {};
  options.tolerance = 1e-12;
  EXPECT_EQ(*resolve(options).gap, 0);
  options.gap = 1e-2;
  EXPECT_EQ(*resolve(options).gap, 1e-2);
}

TEST(GapOption, RefusesGapsThatProveNothing) {
  const auto refused = [](auto change) {
    SolverOptions options;
    options.gap = 1e-3;
    change(options);
    EXPECT_THROW(validate(options), OptionError);
  };
  refused([](auto& o) { o.gap = -1; });
  refused([](auto& o) { o.gap = std::nan(""); });
  refused([](auto& o) { o.non_negative = NonNegative::kOff; });
  refused([](auto& o) { o.method = Method::kPaper; });
}

}  // namespace
}  // namespace flbc::testing
