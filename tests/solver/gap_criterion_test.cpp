// SPDX-License-Identifier: BSD-3-Clause
// Runs that end because their weights are proved to be near the optimum.
#include "flbc/report.h"
#include "solver/plan/constants.h"
#include "solver/run/run.h"
#include "support/solver_options.h"

namespace flbc::testing {
namespace {

SolverOptions never_by_tolerance(double gap) {
  SolverOptions options;
  options.tolerance = 1e-30;
  options.gap = gap;
  options.max_iterations = 2000;
  return options;
}

// Many control points on a round cage leave the weights nearly undetermined without smoothness, but
// not the objective.
TEST_IN_2D_AND_3D(GapCriterionTest, EndsRunsWithoutSmoothness) {
  Cage<Dim> cage;
  if constexpr (Dim == 2) {
    cage = regular_polygon(24);
  } else {
    cage = round_cage(2);
  }
  const auto mesh = mesh_of(cage, 700);
  const auto [weights, report] = solve(cage, mesh, without_smoothness());
  EXPECT_EQ(report.status, SolveStatus::kConverged);
  EXPECT_EQ(report.criterion, Criterion::kGap);
  EXPECT_LE(report.certificate.relative_gap, 1e-3);
  EXPECT_NEAR(report.certificate.objective, report.objective, 1e-9 * report.objective);
  EXPECT_GE(weights.dense().minCoeff(), 0);
  const auto better =
      solve(cage, mesh, many_iterations(2 * report.iterations, without_smoothness()));
  EXPECT_NE(better.report.criterion, Criterion::kGap);
  EXPECT_LE(report.objective, (1 + 1e-3) * better.report.objective);
  EXPECT_LE(report.certificate.lower_bound, better.report.objective);
}

TEST_IN_2D_AND_3D(GapCriterionTest, EndsAllMethodsThatHaveDuals) {
  const auto sample = make_sample<Dim>(Shape::kCorner, 3, 0.2);
  for (const auto method : {Method::kWeights, Method::kLbc2014, Method::kGradient}) {
    SCOPED_TRACE(name_of(method));
    // The iteration of kGradient does not know that weights are not negative.
    const double gap = method == Method::kGradient ? 0.9 : 0.2;
    auto options = never_by_tolerance(gap);
    options.method = method;
    const auto solution = solve(sample.cage, sample.mesh, options);
    EXPECT_EQ(solution.report.criterion, Criterion::kGap);
    EXPECT_LE(solution.report.certificate.relative_gap, gap);
    // Certificates on the way do not change the iteration.
    options.gap = 0;
    options.max_iterations = solution.report.iterations;
    const auto plain = solve(sample.cage, sample.mesh, options);
    EXPECT_EQ(plain.report.status, SolveStatus::kIterationLimit);
    EXPECT_TRUE(plain.weights == solution.weights);
  }
}

TEST_IN_2D_AND_3D(GapCriterionTest, HoldsForMovedCages) {
  const auto sample = make_sample<Dim>(Shape::kCorner, 3, 0.2);
  Solver<Dim> solver(sample.cage, sample.mesh, never_by_tolerance(0.2));
  EXPECT_EQ(solver.solve().report.criterion, Criterion::kGap);
  EXPECT_EQ(solver.reshape(sample.cage.points).report.criterion, Criterion::kGap);
}

// An iteration whose certificate is given, and that counts how often it is asked for.
struct Certified : Iteration<2> {
  double gap = 0;
  bool has_duals = true;
  mutable int asked = 0;

  void start(const Start<2>&) override {}
  Step iterate(int, int) override { return {}; }
  Weights weights() const override { return {WeightMatrix::Zero(3, 1), {}}; }
  bool can_certify() const override { return has_duals; }
  Certificate certify(const WeightMatrix&, Proof*) const override {
    ++asked;
    return {1, 1 - gap, gap, {}};
  }
  void describe(SolveReport&) const override {}
};

TEST(GapCriterion, AsksForFewCertificatesAtTimesThatOnlyIterationsDecide) {
  for (const double target : {1e-2, 1e-5}) {
    Certified iteration;
    iteration.gap = 1.1 * target;
    GapCriterion criterion;
    for (int made = 1; made <= 10000; ++made) {
      EXPECT_FALSE(criterion.is_met(target, iteration, made));
    }
    EXPECT_GT(iteration.asked, 3);
    EXPECT_LT(iteration.asked, 30);
    iteration.gap = 0.9 * target;
    EXPECT_TRUE(criterion.is_met(target, iteration, 20000));
    EXPECT_FALSE(GapCriterion().is_met(0, iteration, 20000));
    iteration.has_duals = false;
    EXPECT_FALSE(GapCriterion().is_met(target, iteration, 20000));
  }
}

// An iteration without changes whose set of pairs grows when the run would end.
struct Growing : Certified {
  std::vector<int> growths{};

  bool adapt(const Milestone& at) override {
    if (!at.ends || growths.size() == 3) return false;
    growths.push_back(at.made);
    return true;
  }
};

// New pairs have no duals yet, so their first changes say little.
TEST(Run, MakesIterationsOnNewPairsBeforeItEnds) {
  const auto problem = smooth_problem(make_sample<2>(Shape::kBox, 2));
  const auto settings = plan::settings_of({});
  const Observer nobody;
  SolveReport report;
  Growing iteration;
  RunState state{StopRule::estimate(1, 1)};
  run<2>(iteration, state, {problem, settings, Reporter(nobody)}, report);
  EXPECT_EQ(report.status, SolveStatus::kConverged);
  EXPECT_EQ(iteration.growths,
            (std::vector<int>{plan::kFewestIterations, 2 * plan::kFewestIterations,
                              3 * plan::kFewestIterations}));
  EXPECT_EQ(report.iterations, 4 * plan::kFewestIterations);
}

TEST(GapOption, IsSetWhereTheOptimumDoesNotDetermineTheWeights) {
  const auto gap = [](Method method, double smoothness, std::optional<double> tolerance = {},
                      std::optional<double> given = {}) {
    SolverOptions options{method};
    options.smoothness = smoothness;
    options.tolerance = tolerance;
    options.gap = given;
    return *resolve(options).gap;
  };
  for (const auto method : {Method::kWeights, Method::kGradient}) {
    EXPECT_EQ(gap(method, 0), 1e-3);
    EXPECT_EQ(gap(method, 0.01), 0);
    EXPECT_EQ(gap(method, 0, 1e-6), 0);
    EXPECT_EQ(gap(method, 0, 1e-6, 1e-2), 1e-2);
    EXPECT_EQ(gap(method, 0, {}, 0), 0);
  }
  for (const auto method : {Method::kPaper, Method::kLbc2014}) EXPECT_EQ(gap(method, 0), 0);
}

}  // namespace
}  // namespace flbc::testing
