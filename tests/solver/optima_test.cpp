// SPDX-License-Identifier: BSD-3-Clause
// The library's solvers against optima of an interior-point method (tests/data/references), with
// which they have nothing in common but the problem.
#include "flbc/harmonic.h"
#include "flbc/options.h"
#include "solver/methods/splitting/compact_splitting.h"
#include "support/reference_optimum.h"
#include "support/solver_options.h"

namespace flbc::testing {
namespace {

// Twice the largest gap allowed to the program that made the references.
constexpr double kObjectiveTolerance = 2e-8;

// By independent measures and by the setup of the library. That they are optimal follows from
// OptimaTest: bounds by certificates come near them.
TEST_IN_2D_AND_3D(ReferencesTest, AreFeasibleAndHaveTheStatedObjectives) {
  std::set<std::string> names;
  int constrained = 0;  // cases without which a solver that ignores w >= 0 would pass
  for (const auto& reference : reference_optima<Dim>()) {
    SCOPED_TRACE(reference.name);
    names.insert(reference.name);
    const auto& [free, non_negative] = std::tie(reference.unconstrained, reference.non_negative);
    for (const auto* variant : {&free, &non_negative}) {
      const auto judgement =
          expect_coordinates(reference.cage, reference.mesh, variant->weights, 1e-12);
      EXPECT_EQ(judgement.control_points_found, reference.cage.size());
      EXPECT_LT(judgement.linearity_error, 1e-12);
      EXPECT_NEAR(testing::objective(reference.mesh, variant->weights, reference.phi),
                  variant->objective, 1e-8 * variant->objective);
      EXPECT_LT(std::abs(variant->gap), 1e-8);
    }
    EXPECT_GE(non_negative.weights.minCoeff(), -1e-9);
    EXPECT_GE(non_negative.objective, free.objective * (1 - kObjectiveTolerance));
    if (free.weights.minCoeff() < -1e-3) {
      ++constrained;
      EXPECT_GT((free.weights - non_negative.weights).cwiseAbs().maxCoeff(), 1e-3);
      EXPECT_GT(non_negative.objective, free.objective);
    }
    EXPECT_TRUE(find_defects(reference.cage).empty());
    EXPECT_GE(reference.phi.minCoeff(), 0);
    EXPECT_LE(reference.phi.maxCoeff(), 1);
    const auto problem = make_problem(reference.cage, reference.mesh, DistanceScheme::kConstant, 0);
    ASSERT_EQ(problem.mesh.cells, reference.mesh.cells);
    const double scaled = non_negative.objective * std::pow(problem.scale, Dim - 1);
    EXPECT_NEAR(testing::objective(problem.mesh, non_negative.weights, reference.phi), scaled,
                1e-8 * scaled);
  }
  EXPECT_EQ(names.size(), reference_optima<Dim>().size());
  EXPECT_GE(names.size(), 4u);
  EXPECT_GE(constrained, Dim == 2 ? 1 : 2);
}

template <int Dim>
LbcProblem<Dim> problem_of(const ReferenceOptimum<Dim>& reference) {
  auto problem = make_problem(reference.cage, reference.mesh, DistanceScheme::kConstant, 0);
  problem.phi = reference.phi;
  return problem;
}

// The penalties suit these small meshes and the long way to an accurate optimum; the automatic ones
// suit larger meshes and fewer digits.
template <int Dim>
SolverOptions accurate(const LbcProblem<Dim>& problem, Method method, NonNegative non_negative) {
  auto options = many_iterations(4000, without_smoothness());
  options.method = method;
  options.non_negative = non_negative;
  double penalty = 300;
  if (method == Method::kLbc2014) {
    options.max_iterations = 8000;
    penalty = Dim == 2 ? 3 : 0.03;
  }
  options.penalty = published_penalty(problem.cage, problem.mesh, method, penalty);
  return options;
}

template <int Dim, class Variant>
void expect_optimal(const LbcProblem<Dim>& problem, const WeightMatrix& weights,
                    const Variant& reference) {
  const double objective = testing::objective(problem.mesh, weights, problem.phi.dense()) /
                           std::pow(problem.scale, Dim - 1);
  EXPECT_NEAR(objective, reference.objective, 1e-6 * reference.objective);
  EXPECT_LT((weights - reference.weights).cwiseAbs().maxCoeff(), 1e-4);
}

template <int Dim>
void expect_found(Method method, NonNegative non_negative) {
  for (const auto& reference : reference_optima<Dim>()) {
    SCOPED_TRACE(reference.name);
    const auto problem = problem_of(reference);
    expect_optimal(
        problem, solve(problem, accurate(problem, method, non_negative)).weights.dense(),
        non_negative == NonNegative::kOff ? reference.unconstrained : reference.non_negative);
  }
}

TEST_IN_2D_AND_3D(OptimaTest, WeightsFindBothOptima) {
  expect_found<Dim>(Method::kWeights, NonNegative::kOff);
  expect_found<Dim>(Method::kWeights, NonNegative::kConstraint);
}

TEST_IN_2D_AND_3D(OptimaTest, TheOriginalSolverFindsTheUnconstrainedOptimum) {
  expect_found<Dim>(Method::kLbc2014, NonNegative::kOff);
}

// As published, W = w weighs 1 whatever the mesh, with which some of these would take millions of
// iterations; the optimum does not depend on it.
TEST_IN_2D_AND_3D(OptimaTest, TheOriginalSolverFindsTheNonNegativeOptimum) {
  for (const auto& reference : reference_optima<Dim>()) {
    SCOPED_TRACE(reference.name);
    const auto problem = problem_of(reference);
    splitting::Metric metric;
    metric.cell.resize(problem.mesh.num_cells());
    for (Index s = 0; s < problem.mesh.num_cells(); ++s) {
      metric.cell[s] = std::pow(simplex_measure<Dim>(cell_corners(problem.mesh, s)), 2);
    }
    const double per_cell = metric.cell.mean() / metric.cell.cwiseSqrt().mean();
    const double size = bounding_box_diagonal(problem.cage.points);
    metric.vertex = Eigen::VectorXd::Constant(
        problem.mesh.num_vertices(),
        100 / (size * size) * metric.cell.sum() / problem.mesh.num_vertices());
    compact::CompactSplitting<double, Dim> splitting(problem, metric,
                                                     {0.6 * size / per_cell, 1.65});
    splitting.start_from_weights(harmonic_coordinates(problem));
    splitting.iterate(0, 8000);
    expect_optimal(problem, splitting.all_weights(), reference.non_negative);
  }
}

// A bound is below the optimum at any time, and close in the end.
TEST_IN_2D_AND_3D(OptimaTest, CertificatesHold) {
  for (const auto& reference : reference_optima<Dim>()) {
    const auto problem = problem_of(reference);
    const double optimum = reference.non_negative.objective;
    for (const auto method :
         {Method::kWeights, Method::kLbc2014, Method::kGradient, Method::kPaper}) {
      for (const int iterations : {1, 3, 10, 100, 3000}) {
        SCOPED_TRACE(reference.name + ", method " + std::to_string(static_cast<int>(method)) +
                     ", iterations " + std::to_string(iterations));
        auto options = without_smoothness();
        options.method = method;
        options.tolerance = 1e-17;
        options.max_iterations = iterations;
        options.certify = true;
        const auto certificate = solve(problem, options).report.certificate;
        EXPECT_LE(certificate.lower_bound, optimum * (1 + 1e-9));
        EXPECT_GE(certificate.objective, optimum * (1 - 1e-9));
        EXPECT_NEAR(certificate.relative_gap, 1 - certificate.lower_bound / certificate.objective,
                    1e-12);
        if (method == Method::kWeights && iterations == 3000) {
          EXPECT_LT(certificate.relative_gap, 1e-4);
        }
      }
    }
  }
}

}  // namespace
}  // namespace flbc::testing
