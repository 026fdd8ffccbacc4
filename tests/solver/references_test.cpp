// SPDX-License-Identifier: BSD-3-Clause
// Checks the reference optima by independent measures and by the setup of the library. That they
// are optimal follows from optima_test.cpp: bounds by certificates come near them.
#include "flbc/lbc_problem.h"
#include "support/reference_optimum.h"
#include "support/test.h"

namespace flbc::testing {
namespace {

// Twice the largest gap allowed to the program that made the references.
constexpr double kObjectiveTolerance = 2e-8;

template <int Dim>
const std::vector<ReferenceOptimum<Dim>>& references() {
  static const auto all = reference_optima<Dim>();
  return all;
}

TEST_IN_2D_AND_3D(ReferencesTest, AreFeasible) {
  for (const auto& reference : references<Dim>()) {
    for (const auto* variant : {&reference.unconstrained, &reference.non_negative}) {
      SCOPED_TRACE(reference.name);
      const auto judgement = judge(reference.cage, reference.mesh, variant->weights);
      EXPECT_LT(judgement.partition_error, 1e-12);
      EXPECT_LT(judgement.reproduction_error, 1e-12);
      EXPECT_EQ(judgement.control_points_found, reference.cage.size());
      EXPECT_EQ(judgement.lagrange_error, 0);
      EXPECT_EQ(judgement.boundary_vertices_off_cage, 0);
      EXPECT_LT(judgement.linearity_error, 1e-12);
    }
    EXPECT_GE(reference.non_negative.weights.minCoeff(), -1e-9);
  }
}

TEST_IN_2D_AND_3D(ReferencesTest, HaveTheStatedObjectives) {
  for (const auto& reference : references<Dim>()) {
    SCOPED_TRACE(reference.name);
    for (const auto* variant : {&reference.unconstrained, &reference.non_negative}) {
      EXPECT_NEAR(testing::objective(reference.mesh, variant->weights, reference.phi),
                  variant->objective, 1e-8 * variant->objective);
      EXPECT_LT(std::abs(variant->gap), 1e-8);
    }
    EXPECT_GE(reference.non_negative.objective,
              reference.unconstrained.objective * (1 - kObjectiveTolerance));
  }
}

// Without such cases a solver that ignores the constraint would pass all comparisons.
TEST_IN_2D_AND_3D(ReferencesTest, HaveCasesInWhichTheConstraintMatters) {
  int cases = 0;
  for (const auto& reference : references<Dim>()) {
    if (reference.unconstrained.weights.minCoeff() > -1e-3) continue;
    ++cases;
    SCOPED_TRACE(reference.name);
    EXPECT_GT(
        (reference.unconstrained.weights - reference.non_negative.weights).cwiseAbs().maxCoeff(),
        1e-3);
    EXPECT_GT(reference.non_negative.objective, reference.unconstrained.objective);
  }
  EXPECT_GE(cases, Dim == 2 ? 1 : 2);
}

TEST_IN_2D_AND_3D(ReferencesTest, AreAcceptedAsProblems) {
  std::set<std::string> names;
  for (const auto& reference : references<Dim>()) {
    SCOPED_TRACE(reference.name);
    names.insert(reference.name);
    EXPECT_TRUE(find_defects(reference.cage).empty());
    EXPECT_GE(reference.phi.minCoeff(), 0);
    EXPECT_LE(reference.phi.maxCoeff(), 1);
    const auto problem = make_problem(reference.cage, reference.mesh, DistanceScheme::kConstant);
    ASSERT_EQ(problem.mesh.cells, reference.mesh.cells);
    const auto& optimum = reference.non_negative;
    const double scaled = optimum.objective * std::pow(problem.scale, Dim - 1);
    EXPECT_NEAR(testing::objective(problem.mesh, optimum.weights, reference.phi), scaled,
                1e-8 * scaled);
  }
  EXPECT_EQ(names.size(), references<Dim>().size());
  EXPECT_GE(names.size(), 4u);
}

}  // namespace
}  // namespace flbc::testing
