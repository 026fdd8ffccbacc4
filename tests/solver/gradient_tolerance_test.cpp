// SPDX-License-Identifier: BSD-3-Clause
// Whether Method::kGradient keeps what its tolerance promises: a mean squared error of its weights,
// from the optimum without non-negativity, which kValue finds by another iteration.
#include <cmath>
#include <string>
#include <type_traits>
#include <vector>

#include <gtest/gtest.h>

#include "flbc/bounding_box.h"
#include "flbc/meshing.h"
#include "flbc/solver.h"
#include "support/judge.h"
#include "support/many_iterations.h"
#include "support/model_cages.h"
#include "support/sample_meshes.h"
#include "support/simplex.h"

namespace flbc::testing {
namespace {

// The tolerance is met up to this factor.
constexpr double kAllowance = 3;

// Iterations of kValue that bring it far closer to the optimum than any tolerance here.
constexpr int kManyIterations = 3000;

template <int Dim>
void expect_promise_kept(const LbcProblem<Dim>& problem, const std::vector<double>& tolerances,
                         const std::vector<LinearSolver>& linear_solvers = {LinearSolver::kAuto}) {
  auto many = many_iterations(kManyIterations);
  many.non_negative = NonNegative::kOff;
  const auto exact = solve(problem, many).weights;
  for (const auto linear_solver : linear_solvers) {
    int previous = 0;
    for (const double tolerance : tolerances) {
      SCOPED_TRACE(std::to_string(tolerance) + ", linear solver " +
                   std::to_string(static_cast<int>(linear_solver)));
      SolverOptions options;
      options.method = Method::kGradient;
      options.non_negative = NonNegative::kOff;
      options.linear_solver = linear_solver;
      options.tolerance = tolerance;
      const auto [weights, sparse, report] = solve(problem, options);
      EXPECT_EQ(report.status, SolveStatus::kConverged);
      const double error = mean_squared_difference(problem.mesh, weights, exact);
      EXPECT_LT(error, kAllowance * tolerance);
      EXPECT_GE(report.iterations, previous);
      previous = report.iterations;
    }
  }
}

template <class Dimension>
class GradientToleranceTest : public ::testing::Test {};
using Dimensions = ::testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(GradientToleranceTest, Dimensions);

// The ring has a hole, which adds period constraints.
TYPED_TEST(GradientToleranceTest, HoldsOnSamples) {
  constexpr int kDim = TypeParam::value;
  for (const auto shape : {Shape::kCorner, Shape::kRing}) {
    const auto sample = make_sample<kDim>(shape, kDim == 2 ? 12 : 4, 0.2);
    SCOPED_TRACE(sample.name);
    const auto problem = make_problem(sample.cage, sample.mesh, DistanceScheme::kSquare);
    expect_promise_kept(problem, {1e-4, 1e-5, 1e-6});
  }
}

// By the sums that define it: what facets measure, roughly, times the squared size.
TYPED_TEST(GradientToleranceTest, ThePenaltyFollowsTheMesh) {
  constexpr int kDim = TypeParam::value;
  for (const Index subdivisions : {3, 6}) {
    const auto sample = make_sample<kDim>(Shape::kCorner, subdivisions, 0.2);
    const auto problem = make_problem(sample.cage, sample.mesh, DistanceScheme::kSquare);
    SolverOptions options;
    options.method = Method::kGradient;
    options.max_iterations = 1;
    double squares = 0, measure = 0;
    for (Index s = 0; s < problem.mesh.num_cells(); ++s) {
      const double own = simplex_measure<kDim>(cell_corners(problem.mesh, s));
      squares += own * own;
      measure += own;
    }
    const double facet = std::pow(squares / measure, (kDim - 1.0) / kDim);
    const double size = bounding_box_diagonal(problem.cage.points);
    const double expected = size * size * facet / (kDim == 2 ? 3500 : 6000);
    EXPECT_NEAR(solve(problem, options).report.penalty, expected, 1e-9 * expected);
  }
}

struct Model {
  const char* name;
  const char* file;
  double finest = 1e-6;  // tolerance; where more takes thousands of iterations it is left out
};

DomainMesh<2> mesh_of(const Cage<2>& cage) {
  return triangulate(cage, {2000});
}
DomainMesh<3> mesh_of(const Cage<3>& cage) {
  return tetrahedralize(cage, {2000});
}

template <int Dim>
void expect_promise_kept_on(const Model& model) {
  if (!has_model(model.file)) GTEST_SKIP() << model_path(model.file) << " is absent";
  const auto cage = load_cage<Dim>(model.file);
  std::vector<double> tolerances = {1e-4, 1e-5, 1e-6};
  while (tolerances.back() < model.finest) tolerances.pop_back();
  expect_promise_kept(make_problem(cage, mesh_of(cage), DistanceScheme::kSquare), tolerances,
                      {LinearSolver::kAuto, LinearSolver::kNone});
}

std::string name_of(const ::testing::TestParamInfo<Model>& info) {
  return info.param.name;
}

class LongGradientTolerance2d : public ::testing::TestWithParam<Model> {};
TEST_P(LongGradientTolerance2d, HoldsWithAndWithoutALinearSystem) {
  expect_promise_kept_on<2>(GetParam());
}
INSTANTIATE_TEST_SUITE_P(Models, LongGradientTolerance2d,
                         ::testing::Values(Model{"woody", "2d/woody-control-edgeset.obj"},
                                           Model{"cactus", "2d/cactus-control-edgeset.obj"},
                                           Model{"logo", "2d/LBClogo-control-edgeset.obj"}),
                         name_of);

class LongGradientTolerance3d : public ::testing::TestWithParam<Model> {};
TEST_P(LongGradientTolerance3d, HoldsWithAndWithoutALinearSystem) {
  expect_promise_kept_on<3>(GetParam());
}
INSTANTIATE_TEST_SUITE_P(Models, LongGradientTolerance3d,
                         ::testing::Values(Model{"horse", "3d/horse_cage.obj"},
                                           Model{"shark", "3d/shark_cage.obj"},
                                           Model{"beast", "3d/beast_cage.obj"},
                                           Model{"arm", "3d/arm_cage.obj", 1e-5}),
                         name_of);

}  // namespace
}  // namespace flbc::testing
