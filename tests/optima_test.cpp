// SPDX-License-Identifier: BSD-3-Clause
// The library's solvers against optima of an interior-point method (tests/data/references): three
// iterations and a fourth method that have nothing in common but the problem.
#include <cmath>
#include <type_traits>

#include <gtest/gtest.h>

#include "flbc/certificate.h"
#include "flbc/coordinates.h"
#include "flbc/solver.h"
#include "support/reference_optimum.h"

namespace flbc::testing {
namespace {

template <class Dimension>
class OptimaTest : public ::testing::Test {};
using Dimensions = ::testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(OptimaTest, Dimensions);

template <int Dim>
LbcProblem<Dim> problem_of(const ReferenceOptimum<Dim>& reference) {
  auto problem = make_problem(reference.cage, reference.mesh, DistanceScheme::kConstant);
  problem.phi = reference.phi;
  return problem;
}

SolverOptions accurate(Method method, NonNegative non_negative) {
  SolverOptions options;
  options.method = method;
  options.non_negative = non_negative;
  options.precision = Precision::kDouble;
  options.tolerance = 1e-17;
  options.max_iterations = 20000;
  // The default penalty suits the size and the smoothness of real models, not these.
  if (method == Method::kGradient) options.penalty = 5e5;
  return options;
}

template <class Variant>
void expect_optimal(const Solution& solution, const Variant& reference) {
  EXPECT_NEAR(solution.report.objective, reference.objective, 1e-6 * reference.objective);
  EXPECT_LT((solution.weights - reference.weights).cwiseAbs().maxCoeff(), 1e-4);
}

TYPED_TEST(OptimaTest, ValueFindsBothOptima) {
  for (const auto& reference : reference_optima<TypeParam::value>()) {
    SCOPED_TRACE(reference.name);
    const auto problem = problem_of(reference);
    expect_optimal(solve(problem, accurate(Method::kValue, NonNegative::kOff)),
                   reference.unconstrained);
    expect_optimal(solve(problem, accurate(Method::kValue, NonNegative::kConstraint)),
                   reference.non_negative);
  }
}

TYPED_TEST(OptimaTest, TheOriginalSolverFindsBothOptima) {
  for (const auto& reference : reference_optima<TypeParam::value>()) {
    SCOPED_TRACE(reference.name);
    const auto problem = problem_of(reference);
    auto options = accurate(Method::kLbc2014, NonNegative::kOff);
    expect_optimal(solve(problem, options), reference.unconstrained);
    options.non_negative = NonNegative::kConstraint;
    expect_optimal(solve(problem, options), reference.non_negative);
  }
}

TYPED_TEST(OptimaTest, GradientFindsTheUnconstrainedOptimum) {
  for (const auto& reference : reference_optima<TypeParam::value>()) {
    SCOPED_TRACE(reference.name);
    expect_optimal(solve(problem_of(reference), accurate(Method::kGradient, NonNegative::kOff)),
                   reference.unconstrained);
  }
}

// A bound is below the optimum at any time, and close in the end.
TYPED_TEST(OptimaTest, CertificatesHold) {
  for (const auto& reference : reference_optima<TypeParam::value>()) {
    const auto problem = problem_of(reference);
    const double optimum = reference.non_negative.objective;
    for (const auto method :
         {Method::kValue, Method::kLbc2014, Method::kGradient, Method::kPaper}) {
      for (const int iterations : {1, 3, 10, 100, 3000}) {
        SCOPED_TRACE(reference.name + ", method " + std::to_string(static_cast<int>(method)) +
                     ", iterations " + std::to_string(iterations));
        SolverOptions options;
        options.method = method;
        options.tolerance = 1e-17;
        options.max_iterations = iterations;
        options.certify = true;
        const auto certificate = solve(problem, options).report.certificate;
        EXPECT_LE(certificate.lower_bound, optimum * (1 + 1e-9));
        EXPECT_GE(certificate.objective, optimum * (1 - 1e-9));
        EXPECT_NEAR(certificate.relative_gap, 1 - certificate.lower_bound / certificate.objective,
                    1e-12);
        if (method == Method::kValue && iterations == 3000) {
          EXPECT_LT(certificate.relative_gap, 1e-3);
        }
      }
    }
  }
}

}  // namespace
}  // namespace flbc::testing
