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

TEST_IN_2D_AND_3D(ReferencesTest, AreFeasibleAndHaveTheStatedObjectives) {
  std::set<std::string> names;
  int constrained = 0;  // cases without which a solver that ignores w >= 0 would pass
  for (const auto& reference : reference_optima<Dim>()) {
    SCOPED_TRACE(reference.name);
    names.insert(reference.name);
    const auto& [free, non_negative] = std::tie(reference.unconstrained, reference.non_negative);
    for (const auto* variant : {&free, &non_negative}) {
      const auto judgement = judge(reference.cage, reference.mesh, variant->weights);
      EXPECT_LT(judgement.partition_error, 1e-12);
      EXPECT_LT(judgement.reproduction_error, 1e-12);
      EXPECT_EQ(judgement.control_points_found, reference.cage.size());
      EXPECT_EQ(judgement.lagrange_error, 0);
      EXPECT_EQ(judgement.boundary_vertices_off_cage, 0);
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

}  // namespace
}  // namespace flbc::testing
