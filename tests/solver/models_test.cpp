// SPDX-License-Identifier: BSD-3-Clause
// From cage to coordinates on real cages: every documented property, measured independently.

#include "support/solver_models.h"
#include "support/solver_options.h"

namespace flbc::testing {
namespace {

template <int Dim>
void expect_properties(const Model& model) {
  if (!has_model(model.file)) GTEST_SKIP() << "the real models are absent";
  const auto cage = load_cage<Dim>(model.file);
  const auto mesh = mesh_of(cage, model.vertices);
  EXPECT_NEAR(mesh.num_vertices(), model.vertices, (Dim == 2 ? 0.05 : 0.1) * model.vertices);
  auto options = without_smoothness();
  options.certify = true;
  const auto plain = solve(cage, mesh, options).report;
  EXPECT_EQ(plain.criterion, Criterion::kGap);
  EXPECT_LE(plain.certificate.relative_gap, 1e-3);
  const auto solution = solve(cage, mesh);
  EXPECT_EQ(solution.report.criterion, Criterion::kTolerance);
  EXPECT_GT(solution.report.objective, plain.certificate.lower_bound);
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
  EXPECT_LT(solution.report.quality.mean_influences, 8);
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
