// SPDX-License-Identifier: BSD-3-Clause
// From cage to coordinates on real cages: every promised property, measured by the judge.
#include <type_traits>

#include <gtest/gtest.h>

#include "flbc/coordinates.h"
#include "flbc/io/weights_io.h"
#include "flbc/meshing.h"
#include "flbc/solver.h"
#include "support/judge.h"
#include "support/model_cages.h"

namespace flbc::testing {
namespace {

struct Model {
  const char* name;
  const char* file;
  Index vertices;
};

std::string name_of(const ::testing::TestParamInfo<Model>& info) {
  return info.param.name;
}

DomainMesh<2> mesh_of(const Cage<2>& cage, Index vertices) {
  return triangulate(cage, {vertices});
}
DomainMesh<3> mesh_of(const Cage<3>& cage, Index vertices) {
  return tetrahedralize(cage, {vertices});
}

template <int Dim>
void expect_properties(const Model& model, double least_weight, double tolerance) {
  if (!has_model(model.file)) GTEST_SKIP() << model_path(model.file) << " is absent";
  const auto cage = load_cage<Dim>(model.file);
  const auto mesh = mesh_of(cage, model.vertices);
  SolverOptions options;
  options.tolerance = tolerance;
  const auto solution = solve(cage, mesh, options);
  EXPECT_EQ(solution.report.status, SolveStatus::kConverged);
  const auto judgement = judge(cage, mesh, solution.weights);
  EXPECT_LT(judgement.partition_error, 1e-12);
  // TetGen's points on facets lie beside them by up to 1e-9 of the cage's size.
  EXPECT_LT(judgement.reproduction_error, Dim == 2 ? 1e-12 : 1e-8);
  EXPECT_EQ(judgement.lagrange_error, 0);
  EXPECT_LT(judgement.linearity_error, 1e-9);
  EXPECT_EQ(judgement.control_points_found, cage.size());
  EXPECT_EQ(judgement.boundary_vertices_off_cage, 0);
  EXPECT_GT(judgement.min_weight, least_weight);
  for (const char* extension : {"npy", "dmat", "mtx"}) {
    const auto path = ::testing::TempDir() + "/flbc_model." + extension;
    io::write_weights(path, solution.weights);
    EXPECT_TRUE((io::read_weights(path).array() == solution.weights.array()).all()) << extension;
  }
}

class Models2d : public ::testing::TestWithParam<Model> {};
TEST_P(Models2d, DefaultTolerance) {
  expect_properties<2>(GetParam(), -0.05, 0);
}
TEST_P(Models2d, TighterTolerance) {
  expect_properties<2>(GetParam(), -0.001, 5e-6);
}
INSTANTIATE_TEST_SUITE_P(Paper, Models2d,
                         ::testing::Values(Model{"woody", "2d/woody-control-edgeset.obj", 10800},
                                           Model{"cactus", "2d/cactus-control-edgeset.obj", 10800},
                                           Model{"logo", "2d/LBClogo-control-edgeset.obj", 26800}),
                         name_of);

// In 3D the optimum itself has negative weights on meshes like these (docs/results.md).
class Models3d : public ::testing::TestWithParam<Model> {};
TEST_P(Models3d, DefaultTolerance) {
  expect_properties<3>(GetParam(), -0.1, 0);
}
INSTANTIATE_TEST_SUITE_P(Paper, Models3d,
                         ::testing::Values(Model{"horse", "3d/horse_cage.obj", 5900},
                                           Model{"armadillo", "3d/armadillo_cage.obj", 6600}),
                         name_of);

}  // namespace
}  // namespace flbc::testing
