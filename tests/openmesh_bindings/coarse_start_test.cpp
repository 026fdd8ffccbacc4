// SPDX-License-Identifier: BSD-3-Clause
// A program that links a mesher starts from coarser meshes without saying so.
#include <cmath>

#include <gtest/gtest.h>
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>

#include "flbc/meshing.h"
#include "flbc/openmesh/bind.h"
#include "flbc/openmesh/lbc.h"
#include "support/sample_meshes.h"
#include "support/wide_meshes.h"

namespace flbc::testing {
namespace {

using Tri = OpenMesh::TriMesh_ArrayKernelT<DoublePoints>;

// A star, so that 32 control points are the corners of a cage.
Cage<2> star() {
  constexpr int kCorners = 32;
  Cage<2> cage;
  cage.points.resize(2, kCorners);
  cage.facets.resize(2, kCorners);
  for (int k = 0; k < kCorners; ++k) {
    const double angle = 2 * M_PI * k / kCorners, radius = k % 2 == 0 ? 1 : 0.6;
    cage.points.col(k) << radius * std::cos(angle), radius * std::sin(angle);
    cage.facets.col(k) << k, (k + 1) % kCorners;
  }
  return cage;
}

double mean_squared_difference(const WeightMatrix& a, const WeightMatrix& b) {
  return (a - b).array().square().mean();
}

TEST(CoarseStart, IsTakenInThePlaneWhereItPays) {
  const auto cage = star();
  const auto domain = triangulate(cage, {9000});
  auto mesh = openmesh::to_mesh<Tri>(domain);
  const auto report = openmesh::solve(mesh, cage);
  ASSERT_EQ(report.coarse_levels.size(), 1U);
  EXPECT_LT(report.coarse_levels[0].vertices, report.vertices / 5);
  const auto weights = openmesh::get_weights(mesh);
  // None is to be had, or wanted.
  SolverOptions cold;
  cold.coarse_to_fine = CoarseToFine::kOff;
  EXPECT_TRUE(openmesh::solve(mesh, cage, cold).coarse_levels.empty());
  EXPECT_LT(mean_squared_difference(weights, openmesh::get_weights(mesh)), 1e-6);
  EXPECT_TRUE(openmesh::solve(mesh, cage, {}, {}, {}).coarse_levels.empty());
  // Bound on the same mesh of the interior, too.
  Tri model;
  model.add_vertex({0.1, 0.2, 0});
  EXPECT_EQ(openmesh::bind(model, cage, domain).solve.coarse_levels.size(), 1U);
}

TEST(CoarseStart, IsThereInSpace) {
  const auto sample = make_sample<3>(Shape::kBox, 9);
  auto mesh = openmesh::TetMesh::from(sample.mesh);
  SolverOptions options;
  options.coarse_to_fine = CoarseToFine::kOn;
  options.coarse_levels.coarsest = 20;
  EXPECT_FALSE(openmesh::solve(mesh, sample.cage, options).coarse_levels.empty());
  // A state to go on from is a better start.
  openmesh::PropertyOptions properties;
  properties.keep_state = true;
  openmesh::solve(mesh, sample.cage, options, properties);
  const auto resumed = openmesh::solve(mesh, sample.cage, options, properties);
  EXPECT_TRUE(resumed.resumed);
  EXPECT_TRUE(resumed.coarse_levels.empty());
}

}  // namespace
}  // namespace flbc::testing
