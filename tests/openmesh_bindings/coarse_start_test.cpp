// SPDX-License-Identifier: BSD-3-Clause
// Refined meshes are recognized as those of OpenMesh.

#include "flbc/meshing.h"
#include "flbc/nested_mesh.h"
#include "flbc/openmesh/bind.h"
#include "flbc/openmesh/lbc.h"
#include "support/wide_meshes.h"

namespace flbc::testing {
namespace {

// All that saves time in solve() of a cage and a mesh is used here, too.
template <int Dim>
void expect_solve_of_cage_and_mesh(const Cage<Dim>& cage, const DomainMesh<Dim>& domain) {
  SolverOptions options;
  options.tolerance = 1e-5;
  for (const auto pairs : {ActiveSet::kOff, ActiveSet::kOn}) {
    options.active_set = pairs;
    const auto expected = solve<Dim>(cage, domain, options);
    using Mesh = std::conditional_t<Dim == 2, DoubleTri, openmesh::TetMesh>;
    auto mesh = openmesh::to_mesh<Mesh>(domain);
    const auto report = openmesh::solve(mesh, cage, options);
    EXPECT_EQ(report.iterations, expected.report.iterations);
    EXPECT_EQ(report.distances.source, expected.report.distances.source);
    EXPECT_EQ(report.coarse_levels.size(), expected.report.coarse_levels.size());
    EXPECT_EQ(report.state_scalars_per_cell, expected.report.state_scalars_per_cell);
    EXPECT_EQ(report.active_set.density, expected.report.active_set.density);
    EXPECT_EQ(report.active_set.density < 1, pairs == ActiveSet::kOn);
    EXPECT_LT(
        (openmesh::get_weights(mesh).dense() - expected.weights.dense()).cwiseAbs().maxCoeff(),
        1e-3);
  }
}

TEST(CoarseStart, SolvesAsOnArrays) {
  const auto cage = regular_polygon(32, 0.6);
  expect_solve_of_cage_and_mesh(cage, triangulate(cage, {3000}));
  const auto sample = make_sample<3>(Shape::kCorner, 6, 0.1);
  expect_solve_of_cage_and_mesh(sample.cage, refine(sample.mesh));
}

TEST(CoarseStart, WeightsOutliveASolveThatCouldNotBegin) {
  const auto sample = make_sample<3>(Shape::kBox, 4);
  auto mesh = openmesh::TetMesh::from(sample.mesh);
  openmesh::solve(mesh, sample.cage);
  const auto weights = openmesh::get_weights(mesh).dense();
  auto moved = sample.cage;
  moved.points(0, 0) -= 0.5;
  EXPECT_THROW(openmesh::solve(mesh, moved), InputError);
  EXPECT_EQ(openmesh::get_weights(mesh).dense(), weights);
  EXPECT_EQ(openmesh::get_rest_cage(mesh), sample.cage.points);
}

}  // namespace
}  // namespace flbc::testing
