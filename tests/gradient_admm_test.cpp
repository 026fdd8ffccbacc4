// SPDX-License-Identifier: BSD-3-Clause
// The compact iteration against the textbook one, iterate by iterate.
#include "gradient/gradient_admm.h"

#include <type_traits>

#include <gtest/gtest.h>

#include "flbc/recovery.h"
#include "parallel.h"
#include "support/hollow_sample.h"
#include "support/judge.h"
#include "support/sample_meshes.h"
#include "support/textbook_admm.h"

namespace flbc::testing {
namespace {

template <class Dimension>
class GradientAdmmTest : public ::testing::Test {};
using Dimensions = ::testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(GradientAdmmTest, Dimensions);

// A penalty that lets some balls of the Z-step be active and some not.
template <int Dim>
constexpr double kPenalty = Dim == 2 ? 100 : 10000;

template <int Dim>
TextbookAdmm<Dim> textbook_for(const LbcProblem<Dim>& problem,
                               const gradient::GradientAdmm<double, Dim>& admm) {
  TextbookInput<Dim> input;
  input.control_points = problem.cage.points;
  input.mesh = problem.mesh;
  input.phi = problem.phi;
  input.boundary_weights = demanded_boundary_weights(problem.cage, problem.mesh);
  input.penalty = kPenalty<Dim>;
  for (Index s = 0; s < problem.mesh.num_cells(); ++s) {
    input.initial_gradients.push_back(admm.gradients().cell(s));
  }
  return TextbookAdmm<Dim>(std::move(input));
}

template <int Dim>
void expect_equal_iterates(const LbcProblem<Dim>& problem,
                           gradient::GradientAdmm<double, Dim>& admm) {
  auto textbook = textbook_for(problem, admm);
  double largest = 0;
  for (int iteration = 1; iteration <= 50; ++iteration) {
    textbook.iterate();
    const auto residuals = admm.residuals(admm.iterate());
    double difference = 0;
    for (Index s = 0; s < problem.mesh.num_cells(); ++s) {
      const PointList<Dim> expected = textbook.gradient(s);
      largest = std::max(largest, expected.cwiseAbs().maxCoeff());
      difference =
          std::max(difference, (admm.gradients().cell(s) - expected).cwiseAbs().maxCoeff());
    }
    ASSERT_LT(difference, 1e-10 * largest) << "iteration " << iteration;
    EXPECT_NEAR(residuals.primal, textbook.primal_residual_norm(),
                1e-6 * textbook.primal_residual_norm() + 1e-12);
    EXPECT_NEAR(residuals.dual, textbook.dual_residual_norm(),
                1e-6 * textbook.dual_residual_norm() + 1e-12 * kPenalty<Dim>);
  }
  EXPECT_EQ(admm.num_residual_components(),
            static_cast<double>(textbook.num_residual_components()));
}

TYPED_TEST(GradientAdmmTest, EqualsTextbookFromLeastNorm) {
  constexpr int kDim = TypeParam::value;
  for (const auto& sample : samples<kDim>()) {
    SCOPED_TRACE(sample.name);
    const auto problem = make_problem(sample.cage, sample.mesh, DistanceScheme::kSquare);
    gradient::GradientAdmm<double, kDim> admm(problem, kPenalty<kDim>, 1, {});
    admm.start_from_least_norm();
    expect_equal_iterates(problem, admm);
  }
}

TYPED_TEST(GradientAdmmTest, EqualsTextbookFromHarmonicCoordinates) {
  constexpr int kDim = TypeParam::value;
  for (const auto& sample : samples<kDim>()) {
    SCOPED_TRACE(sample.name);
    const auto problem = make_problem(sample.cage, sample.mesh, DistanceScheme::kLinear);
    gradient::GradientAdmm<double, kDim> admm(problem, kPenalty<kDim>, 1, {});
    admm.start_from_weights(harmonic_coordinates(problem));
    expect_equal_iterates(problem, admm);
  }
}

// Over-relaxation changes the path, not the limit.
TYPED_TEST(GradientAdmmTest, RelaxedIterationReachesTheSameOptimum) {
  constexpr int kDim = TypeParam::value;
  const auto sample = make_sample<kDim>(Shape::kCorner, kDim == 2 ? 4 : 2, 0.2);
  const auto problem = make_problem(sample.cage, sample.mesh, DistanceScheme::kSquare);
  const auto optimum = [&](double relaxation, int iterations) {
    gradient::GradientAdmm<double, kDim> admm(problem, kDim == 2 ? 1e4 : 1e5, relaxation, {});
    admm.start_from_least_norm();
    for (int k = 0; k < iterations; ++k) admm.iterate();
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
TYPED_TEST(GradientAdmmTest, PeriodsJoinTheComponentsOfTheBoundary) {
  constexpr int kDim = TypeParam::value;
  const auto sample = make_hollow_sample<kDim>();
  const auto problem = make_problem(sample.cage, sample.mesh, DistanceScheme::kConstant);
  const auto periods = gradient::boundary_periods(problem);
  ASSERT_EQ(periods.size(), 1U);
  const auto gap = [&](const std::vector<gradient::Period<kDim>>& used) {
    gradient::GradientAdmm<double, kDim> admm(problem, kDim == 2 ? 1e4 : 1e5, 1.8, used);
    admm.start_from_least_norm();
    for (int k = 0; k < 1500; ++k) admm.iterate();
    return period_violation(problem, periods[0], admm);
  };
  const double apart = gap({});
  EXPECT_GT(apart, 1e-3 * periods[0].values.cwiseAbs().maxCoeff());
  EXPECT_LT(gap(periods), 1e-2 * apart);
}

TYPED_TEST(GradientAdmmTest, PeriodsHoldForEveryFunctionWithTheRightBoundaryValues) {
  constexpr int kDim = TypeParam::value;
  const auto sample = make_hollow_sample<kDim>();
  const auto problem = make_problem(sample.cage, sample.mesh, DistanceScheme::kConstant);
  auto weights = demanded_boundary_weights(sample.cage, sample.mesh);
  for (Index v = 0; v < problem.mesh.num_vertices(); ++v) {
    if (problem.boundary.slot[v] < 0) weights.col(v).setRandom();
  }
  gradient::GradientAdmm<double, kDim> admm(problem, 1, 1, {});
  admm.start_from_weights(weights);
  for (const auto& period : gradient::boundary_periods(problem)) {
    EXPECT_NEAR(period.field.norm(), 1, 1e-12);
    EXPECT_LT(period_violation(problem, period, admm), 1e-12);
  }
}

TYPED_TEST(GradientAdmmTest, SinglePrecisionFollowsDouble) {
  constexpr int kDim = TypeParam::value;
  const auto sample = make_sample<kDim>(Shape::kRing, 2, 0.2);
  const auto problem = make_problem(sample.cage, sample.mesh, DistanceScheme::kSquare);
  gradient::GradientAdmm<float, kDim> single(problem, kPenalty<kDim>, 1, {});
  gradient::GradientAdmm<double, kDim> exact(problem, kPenalty<kDim>, 1, {});
  single.start_from_least_norm();
  exact.start_from_least_norm();
  double largest = 0;
  double difference = 0;
  for (int k = 0; k < 100; ++k) {
    single.iterate();
    exact.iterate();
  }
  for (Index s = 0; s < problem.mesh.num_cells(); ++s) {
    const auto expected = exact.gradients().cell(s);
    largest = std::max(largest, expected.cwiseAbs().maxCoeff());
    difference =
        std::max(difference, (single.gradients().cell(s) - expected).cwiseAbs().maxCoeff());
  }
  EXPECT_LT(difference, 1e-4 * largest);
}

TYPED_TEST(GradientAdmmTest, ThreadsDoNotChangeABit) {
  constexpr int kDim = TypeParam::value;
  const auto sample = make_sample<kDim>(Shape::kRing, 4, 0.2);
  const auto problem = make_problem(sample.cage, sample.mesh, DistanceScheme::kSquare);
  const auto run = [&](int threads) {
    const ThreadScope scope(threads);
    gradient::GradientAdmm<float, kDim> admm(problem, 1000, 1.8, {});
    admm.start_from_least_norm();
    double residuals = 0;
    for (int k = 0; k < 20; ++k) residuals += admm.residuals(admm.iterate()).primal;
    Eigen::MatrixXd last = admm.gradients().cell(problem.mesh.num_cells() / 2);
    return std::make_pair(residuals, last);
  };
  const auto one = run(1);
  for (const int threads : {2, 4}) {
    const auto many = run(threads);
    EXPECT_EQ(one.first, many.first);
    EXPECT_TRUE((one.second.array() == many.second.array()).all());
  }
}

TYPED_TEST(GradientAdmmTest, StateIsCompact) {
  constexpr int kDim = TypeParam::value;
  const auto sample = make_sample<kDim>(Shape::kBox, kDim == 2 ? 30 : 10, 0);
  const auto problem = make_problem(sample.cage, sample.mesh, DistanceScheme::kConstant);
  const gradient::GradientAdmm<float, kDim> admm(problem, 1, 1, {});
  EXPECT_LE(admm.numbers_per_cell(), kDim == 2 ? 12 : 14);
}

}  // namespace
}  // namespace flbc::testing
