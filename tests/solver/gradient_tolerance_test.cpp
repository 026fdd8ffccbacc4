// SPDX-License-Identifier: BSD-3-Clause
// Whether Method::kGradient keeps what its tolerance promises: a mean squared error of its weights,
// from the optimum without non-negativity, which kValue finds by another iteration.
#include "flbc/solver.h"
#include "support/many_iterations.h"
#include "support/solver_models.h"
#include "support/test.h"

namespace flbc::testing {
namespace {

// Iterations of kValue that bring it far closer to the optimum than any tolerance here.
constexpr int kManyIterations = 3000;

template <int Dim>
void expect_promise_kept(const LbcProblem<Dim>& problem, const std::vector<double>& tolerances,
                         const std::vector<LinearSolver>& linear_solvers = {LinearSolver::kAuto}) {
  auto many = many_iterations(kManyIterations);
  many.non_negative = NonNegative::kOff;
  const auto exact = solve(problem, many).weights.dense();
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
#ifdef _WIN32
      // TetGen places vertices differently here, and the mesh of the arm takes more than usual.
      options.max_iterations = 100000;
#endif
      const auto [weights, report] = solve(problem, options);
      EXPECT_EQ(report.status, SolveStatus::kConverged);
      const double error = mean_squared_difference(problem.mesh, weights.dense(), exact);
      EXPECT_LT(error, kAllowance * tolerance);
      EXPECT_GE(report.iterations, previous);
      previous = report.iterations;
    }
  }
}

// The ring has a hole, which adds period constraints.
TEST_IN_2D_AND_3D(GradientToleranceTest, HoldsOnSamples) {
  for (const auto shape : {Shape::kCorner, Shape::kRing}) {
    const auto sample = make_sample<Dim>(shape, Dim == 2 ? 12 : 4, 0.2);
    SCOPED_TRACE(sample.name);
    const auto problem = make_problem(sample.cage, sample.mesh, DistanceScheme::kSquare);
    expect_promise_kept(problem, {1e-4, 1e-5, 1e-6},
                        {LinearSolver::kDirect, LinearSolver::kMultigrid, LinearSolver::kNone});
  }
}

template <int Dim>
void expect_gradient_promise_kept(const Model& model) {
  if (!has_model(model.file)) GTEST_SKIP() << "the real models are absent";
  const auto cage = load_cage<Dim>(model.file);
  std::vector<double> tolerances = {1e-4, 1e-5, 1e-6};
  while (tolerances.back() < model.finest) tolerances.pop_back();
  expect_promise_kept(make_problem(cage, mesh_of(cage, model.vertices), DistanceScheme::kSquare),
                      tolerances, {LinearSolver::kAuto, LinearSolver::kNone});
}

class LongGradientTolerance : public ::testing::TestWithParam<Model> {};
TEST_P(LongGradientTolerance, HoldsWithAndWithoutALinearSystem) {
  GetParam().is_planar() ? expect_gradient_promise_kept<2>(GetParam())
                         : expect_gradient_promise_kept<3>(GetParam());
}
INSTANTIATE_TEST_SUITE_P(Models, LongGradientTolerance,
                         ::testing::Values(Model{"woody", "2d/woody-control-edgeset.obj", 2000},
                                           Model{"cactus", "2d/cactus-control-edgeset.obj", 2000},
                                           Model{"logo", "2d/LBClogo-control-edgeset.obj", 2000},
                                           Model{"horse", "3d/horse_cage.obj", 2000, 1e-5},
                                           Model{"shark", "3d/shark_cage.obj", 2000},
                                           Model{"beast", "3d/beast_cage.obj", 2000, 1e-5},
                                           Model{"arm", "3d/arm_cage.obj", 950, 1e-4}),
                         name_of_model);

}  // namespace
}  // namespace flbc::testing
