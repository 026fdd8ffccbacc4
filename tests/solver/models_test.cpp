// SPDX-License-Identifier: BSD-3-Clause
// From cage to coordinates on real cages: every documented property, measured independently.

#include "flbc/io/weights_io.h"
#include "flbc/solver.h"
#include "support/scratch.h"
#include "support/solver_models.h"
#include "support/test.h"

namespace flbc::testing {
namespace {

template <int Dim>
void expect_properties(const Model& model) {
  if (!has_model(model.file)) GTEST_SKIP() << "the real models are absent";
  const auto cage = load_cage<Dim>(model.file);
  const auto mesh = mesh_of(cage, model.vertices);
  EXPECT_NEAR(mesh.num_vertices(), model.vertices, (Dim == 2 ? 0.05 : 0.1) * model.vertices);
  SolverOptions options;
  options.certify = true;
  const auto solution = solve(cage, mesh, options);
  EXPECT_EQ(solution.report.status, SolveStatus::kConverged);
  EXPECT_LT(solution.report.certificate.relative_gap, 0.01);
  const auto judgement = judge(cage, mesh, solution.weights.dense());
  EXPECT_LT(judgement.partition_error, 1e-12);
  // TetGen points on facets are off by up to 1e-9 of cage size.
  EXPECT_LT(judgement.reproduction_error, Dim == 2 ? 1e-12 : 1e-8);
  EXPECT_EQ(judgement.lagrange_error, 0);
  EXPECT_LT(judgement.linearity_error, 1e-9);
  EXPECT_EQ(judgement.control_points_found, cage.size());
  EXPECT_EQ(judgement.boundary_vertices_off_cage, 0);
  EXPECT_GE(judgement.min_weight, 0);
  // Locality: few control points influence a vertex, for any number of control points.
  EXPECT_LT(solution.report.quality.mean_influences, 5.5);
  for (const char* extension : {"npy", "dmat", "mtx"}) {
    const auto path = scratch_path(std::string("weights.") + extension);
    io::write_weights(path, solution.weights.dense());
    EXPECT_TRUE((io::read_weights(path).dense().array() == solution.weights.dense().array()).all())
        << extension;
  }
}

// The default tolerance is a mean squared error, so weights of a hundredth of it tell whether that
// was kept; and they are nearer to the optimum by the certificate and by their objective.
template <int Dim>
void expect_tighter_is_better(const Model& model) {
  if (!has_model(model.file)) GTEST_SKIP() << "the real models are absent";
  const auto cage = load_cage<Dim>(model.file);
  const auto mesh = mesh_of(cage, model.vertices);
  const auto problem = make_problem(cage, mesh, DistanceScheme::kSquare);
  SolverOptions options;
  options.certify = true;
  options.gap = 0;
  const auto by_default = solve(problem, options);
  const double tolerance = *resolve(options).tolerance;
  options.tolerance = tolerance / 100;
  options.precision = Precision::kDouble;
  const auto tighter = solve(problem, options);
  EXPECT_EQ(tighter.report.status, SolveStatus::kConverged);
  EXPECT_GT(tighter.report.iterations, by_default.report.iterations);
  EXPECT_LT(mean_squared_difference(mesh, by_default.weights.dense(), tighter.weights.dense()),
            2 * tolerance);
  const auto objective = [&](const Solution& solution) {
    return testing::objective(problem.mesh, solution.weights.dense(), problem.phi.dense());
  };
  EXPECT_LT(objective(tighter), objective(by_default));
  EXPECT_LT(tighter.report.certificate.relative_gap,
            0.3 * by_default.report.certificate.relative_gap);
}

TEST(Models, ATighterToleranceIsBetter) {
  expect_tighter_is_better<2>({"woody", "2d/woody-control-edgeset.obj", 10800});
  expect_tighter_is_better<3>({"horse", "3d/horse_cage.obj", 5900});
}

class RealModels : public ::testing::TestWithParam<Model> {};
TEST_P(RealModels, DefaultTolerance) {
  GetParam().is_planar() ? expect_properties<2>(GetParam()) : expect_properties<3>(GetParam());
}
INSTANTIATE_TEST_SUITE_P(Paper, RealModels,
                         ::testing::Values(Model{"woody", "2d/woody-control-edgeset.obj", 10800},
                                           Model{"cactus", "2d/cactus-control-edgeset.obj", 10800},
                                           Model{"logo", "2d/LBClogo-control-edgeset.obj", 26800},
                                           Model{"horse", "3d/horse_cage.obj", 5900},
                                           Model{"armadillo", "3d/armadillo_cage.obj", 6600}),
                         name_of_model);

}  // namespace
}  // namespace flbc::testing
