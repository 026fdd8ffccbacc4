// SPDX-License-Identifier: BSD-3-Clause
// The compact iteration against the textbook one, iterate by iterate.
#include "solver/methods/gradient/gradient_admm.h"

#include "base/parallel.h"
#include "flbc/harmonic.h"
#include "flbc/recovery.h"
#include "support/hollow_sample.h"
#include "support/published_problem.h"
#include "support/textbook_admm.h"

namespace flbc::testing {
namespace {

// A penalty that lets some balls of the Z-step be active and some not.
template <int Dim>
constexpr double kPenalty = Dim == 2 ? 100 : 10000;

template <int Dim>
TextbookAdmm<Dim> textbook_for(const LbcProblem<Dim>& problem,
                               const gradient::GradientAdmm<double, Dim>& admm) {
  TextbookInput<Dim> input;
  input.control_points = problem.cage.points;
  input.mesh = problem.mesh;
  input.phi = problem.phi.dense();
  input.boundary_weights = demanded_boundary_weights(problem.cage, problem.mesh);
  input.penalty = kPenalty<Dim>;
  input.smoothness = problem.smoothness;
  for (Index s = 0; s < problem.mesh.num_cells(); ++s) {
    input.initial_gradients.push_back(admm.gradients().cell(s));
  }
  return TextbookAdmm<Dim>(std::move(input));
}

// The largest difference from gradients of cells, relative to the largest of these.
template <class Scalar, int Dim, class GradientOf>
double relative_difference(const LbcProblem<Dim>& problem,
                           const gradient::GradientAdmm<Scalar, Dim>& admm,
                           const GradientOf& gradient_of) {
  double largest = 0, difference = 0;
  for (Index s = 0; s < problem.mesh.num_cells(); ++s) {
    const PointList<Dim> expected = gradient_of(s);
    largest = std::max(largest, expected.cwiseAbs().maxCoeff());
    difference = std::max(difference, (admm.gradients().cell(s) - expected).cwiseAbs().maxCoeff());
  }
  return difference / largest;
}

template <int Dim>
void expect_equal_iterates(const LbcProblem<Dim>& problem,
                           gradient::GradientAdmm<double, Dim>& admm) {
  auto textbook = textbook_for(problem, admm);
  for (int iteration = 1; iteration <= 50; ++iteration) {
    textbook.iterate();
    const auto residuals = admm.residuals(admm.iterate());
    const auto of_textbook = [&](Index s) { return textbook.gradient(s); };
    ASSERT_LT(relative_difference(problem, admm, of_textbook), 1e-10) << "iteration " << iteration;
    EXPECT_NEAR(residuals.primal, textbook.primal_residual_norm(),
                1e-6 * textbook.primal_residual_norm() + 1e-12);
    EXPECT_NEAR(residuals.dual, textbook.dual_residual_norm(),
                1e-6 * textbook.dual_residual_norm() + 1e-12 * kPenalty<Dim>);
  }
  EXPECT_EQ(admm.num_residual_components(),
            static_cast<double>(textbook.num_residual_components()));
}

TEST_IN_2D_AND_3D(GradientAdmmTest, EqualsTheTextbookIterateByIterate) {
  for (const auto& sample : samples<Dim>()) {
    SCOPED_TRACE(sample.name);
    auto problem = published_problem(sample.cage, sample.mesh, DistanceScheme::kSquare);
    for (const double smoothness : {0.0, 0.02}) {
      problem.smoothness = smoothness;
      gradient::GradientAdmm<double, Dim> harmonic(problem, kPenalty<Dim>, 1, {});
      harmonic.start_from_weights(harmonic_coordinates(problem));
      expect_equal_iterates(problem, harmonic);
      if (smoothness > 0) continue;
      gradient::GradientAdmm<double, Dim> least(problem, kPenalty<Dim>, 1, {});
      least.start_from_least_norm();
      expect_equal_iterates(problem, least);
    }
  }
}

// Over-relaxation changes the path, not the limit.
TEST_IN_2D_AND_3D(GradientAdmmTest, RelaxedIterationReachesTheSameOptimum) {
  const auto sample = make_sample<Dim>(Shape::kCorner, Dim == 2 ? 4 : 2, 0.2);
  const auto problem = published_problem(sample.cage, sample.mesh, DistanceScheme::kSquare);
  const auto optimum = [&](double relaxation, int iterations) {
    gradient::GradientAdmm<double, Dim> admm(problem, Dim == 2 ? 1e4 : 1e5, relaxation, {});
    admm.start_from_least_norm();
    admm.iterate(iterations);
    return integrate_least_squares(problem, admm.gradients());
  };
  const auto plain = optimum(1, 6000);
  const auto relaxed = optimum(1.8, 3000);
  EXPECT_LT(mean_squared_difference(problem.mesh, plain, relaxed), 1e-7);
}

template <int Dim>
double period_violation(const LbcProblem<Dim>& problem, const gradient::Period<Dim>& period,
                        const gradient::GradientAdmm<double, Dim>& admm) {
  Eigen::VectorXd sum = -period.values;
  for (Index s = 0; s < problem.mesh.num_cells(); ++s) {
    sum += admm.gradients().cell(s).transpose() * period.field.col(s);
  }
  return sum.cwiseAbs().maxCoeff();
}

// Along a path from one boundary component to another, gradients must add up to the difference of
// the boundary values; (8)-(10) alone leave that open.
TEST_IN_2D_AND_3D(GradientAdmmTest, PeriodsJoinTheComponentsOfTheBoundary) {
  const auto sample = make_hollow_sample<Dim>();
  const auto problem = published_problem(sample.cage, sample.mesh, DistanceScheme::kConstant);
  const auto periods = gradient::boundary_periods(problem);
  ASSERT_EQ(periods.size(), 1U);
  const auto gap = [&](const std::vector<gradient::Period<Dim>>& used) {
    gradient::GradientAdmm<double, Dim> admm(problem, Dim == 2 ? 1e4 : 1e5, 1.8, used);
    admm.start_from_least_norm();
    admm.iterate(1500);
    return period_violation(problem, periods[0], admm);
  };
  const double apart = gap({});
  EXPECT_GT(apart, 1e-3 * periods[0].values.cwiseAbs().maxCoeff());
  EXPECT_LT(gap(periods), 1e-2 * apart);
}

TEST_IN_2D_AND_3D(GradientAdmmTest, PeriodsHoldForEveryFunctionWithTheRightBoundaryValues) {
  const auto sample = make_hollow_sample<Dim>();
  const auto problem = published_problem(sample.cage, sample.mesh, DistanceScheme::kConstant);
  auto weights = demanded_boundary_weights(sample.cage, sample.mesh);
  for (Index v = 0; v < problem.mesh.num_vertices(); ++v) {
    if (problem.boundary.boundary_index[v] < 0) weights.col(v).setRandom();
  }
  gradient::GradientAdmm<double, Dim> admm(problem, 1, 1, {});
  admm.start_from_weights(weights);
  for (const auto& period : gradient::boundary_periods(problem)) {
    EXPECT_NEAR(period.field.norm(), 1, 1e-12);
    EXPECT_LT(period_violation(problem, period, admm), 1e-12);
  }
}

TEST_IN_2D_AND_3D(GradientAdmmTest, SinglePrecisionFollowsDouble) {
  const auto sample = make_sample<Dim>(Shape::kRing, 2, 0.2);
  const auto problem = published_problem(sample.cage, sample.mesh, DistanceScheme::kSquare);
  gradient::GradientAdmm<float, Dim> single(problem, kPenalty<Dim>, 1, {});
  gradient::GradientAdmm<double, Dim> exact(problem, kPenalty<Dim>, 1, {});
  single.start_from_least_norm();
  exact.start_from_least_norm();
  single.iterate(100);
  exact.iterate(100);
  const auto of_exact = [&](Index s) { return exact.gradients().cell(s); };
  EXPECT_LT(relative_difference(problem, single, of_exact), 1e-4);
}

// Gradients and flux, and what the duals make of them in another iteration.
template <class Scalar, int Dim>
std::vector<double> state_of(const LbcProblem<Dim>& problem,
                             gradient::GradientAdmm<Scalar, Dim>& admm) {
  std::vector<double> state;
  const auto append = [&](const auto& matrix) {
    for (const auto& column : matrix.colwise()) {
      state.insert(state.end(), column.begin(), column.end());
    }
  };
  for (int k = 0; k < 2; ++k) {
    const auto flux = admm.flux();
    for (Index s = 0; s < problem.mesh.num_cells(); ++s) {
      append(admm.gradients().cell(s));
      append(flux.cell(s));
    }
    admm.iterate();
  }
  return state;
}

struct Run {
  std::vector<double> state;
  gradient::Residuals residuals;

  bool operator==(const Run& other) const {
    return state == other.state && residuals.primal == other.residuals.primal &&
           residuals.dual == other.residuals.dual;
  }
};

// From harmonic coordinates, with a given number of iterations per call.
template <class Scalar, int Dim>
Run run_in_steps(const LbcProblem<Dim>& problem, int threads, const std::vector<int>& steps,
                 double relaxation) {
  const ThreadScope scope(threads);
  gradient::GradientAdmm<Scalar, Dim> admm(problem, kPenalty<Dim>, relaxation,
                                           gradient::boundary_periods(problem));
  admm.start_from_weights(harmonic_coordinates(problem));
  Run run;
  for (const int count : steps) run.residuals = admm.residuals(admm.iterate(count));
  run.state = state_of(problem, admm);
  return run;
}

template <class Scalar, int Dim>
void expect_same_bits(const LbcProblem<Dim>& problem, double relaxation) {
  const auto expected = run_in_steps<Scalar>(problem, 1, {1, 1, 1, 1, 1, 1, 1}, relaxation);
  for (const int threads : {1, 2, 3}) {
    for (const auto& steps : {std::vector<int>{7}, {5, 2}, {1, 6}, {1, 1, 1, 1, 1, 1, 1}}) {
      EXPECT_TRUE(run_in_steps<Scalar>(problem, threads, steps, relaxation) == expected)
          << threads << " threads, " << steps.front() << " iterations at first";
    }
  }
  // and the comparison sees a difference
  EXPECT_FALSE(run_in_steps<Scalar>(problem, 1, {6}, relaxation) == expected);
}

TEST_IN_2D_AND_3D(GradientAdmmTest, NeitherThreadsNorIteratingTogetherChangeABit) {
  const auto sample = make_sample<Dim>(Shape::kRing, Dim == 2 ? 16 : 6, 0.2);
  ASSERT_GT(sample.mesh.num_cells(), 4 * kFewestInParallel);
  const auto problem = published_problem(sample.cage, sample.mesh, DistanceScheme::kSquare);
  expect_same_bits<float>(problem, 1.8);
  expect_same_bits<float>(problem, 1);
  expect_same_bits<double>(problem, 1);
}

TEST_IN_2D_AND_3D(GradientAdmmTest, PeriodsAreTheSameBitsIterateByIterate) {
  const auto sample = make_hollow_sample<Dim>();
  const auto problem = published_problem(sample.cage, sample.mesh, DistanceScheme::kConstant);
  ASSERT_EQ(gradient::boundary_periods(problem).size(), 1U);
  expect_same_bits<float>(problem, 1.8);
}

TEST_IN_2D_AND_3D(GradientAdmmTest, StateIsCompact) {
  const auto sample = make_sample<Dim>(Shape::kBox, Dim == 2 ? 30 : 10, 0);
  const auto problem = published_problem(sample.cage, sample.mesh, DistanceScheme::kConstant);
  const gradient::GradientAdmm<float, Dim> admm(problem, 1, 1, {});
  EXPECT_LE(admm.state_scalars_per_cell(), Dim == 2 ? 12 : 14);
}

}  // namespace
}  // namespace flbc::testing
