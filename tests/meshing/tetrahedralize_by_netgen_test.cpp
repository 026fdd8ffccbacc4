// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/meshing.h"

#include "flbc/solver.h"
#include "support/mesh_checks.h"
#include "support/model_cages.h"
#include "support/processor_time.h"

namespace flbc::testing {
namespace {

// A box on which TetGen asks for more than a million vertices.
Cage<3> flat_box() {
  return box_cage<3>(Vector<3>(-1, -1, -5e-4), Vector<3>(1, 1, 5e-4));
}

TEST(TetrahedralizeByNetgenTest, CountAndCoverWhateverTheSizeAndOrientation) {
  for (double size : {1e-6, 1.0, 1e5}) {
    const Cage<3> cage = box_cage<3>(size);
    for (Index count : {0, 600}) {
      const DomainMesh<3> mesh = tetrahedralize_by_netgen(reversed(cage), vertices<3>(count));
      expect_fills(cage, mesh, 8 * size * size * size);
      EXPECT_TRUE(covers_edges(cage, mesh));
      if (count > 0) expect_count(mesh, count, 0.4);  // twelve facets alike
    }
  }
}

TEST(TetrahedralizeByNetgenTest, CavitiesStayEmpty) {
  const Cage<3> box = box_cage<3>(1), cavity = box_cage<3>(0.5);
  for (const Cage<3>& cage : {join(box, cavity), join(reversed(cavity), box)}) {
    expect_fills(cage, tetrahedralize_by_netgen(cage, vertices<3>(600)), 7);
  }
}

TEST(TetrahedralizeByNetgenTest, ThinWallsTakeFlatCellsAndWeightsAreCoordinates) {
  const Cage<3> flat = flat_box();
  const Cage<3> wall = join(box_cage<3>(1), box_cage<3>(0.999));
  for (const Cage<3>& cage : {flat, wall}) {
    const DomainMesh<3> mesh = tetrahedralize_by_netgen(cage, vertices<3>(500));
    const double volume = cage.size() == 8 ? 4e-3 : 8 * (1 - 0.999 * 0.999 * 0.999);
    expect_fills(cage, mesh, volume);
    EXPECT_TRUE(covers_edges(cage, mesh));
    EXPECT_LT(mesh.num_vertices(), 1500);
    const Solution solution = solve(cage, mesh);
    const Quality quality = measure_quality(cage.points, mesh.points, solution.weights.dense());
    EXPECT_LT(quality.max_partition_error, 1e-12);
    EXPECT_LT(quality.max_reproduction_error, 1e-9);
    EXPECT_GE(quality.min_weight, 0);
    EXPECT_EQ(solution.report.status, SolveStatus::kConverged);
  }
}

TEST(TetrahedralizeByNetgenTest, RunsAgreeBitByBit) {
  expect_reproducible([&] { return tetrahedralize_by_netgen(flat_box(), vertices<3>(150)); });
}

TEST(TetrahedralizeByNetgenTest, WhatCannotBeDoneIsRefused) {
  const Cage<3> cage = box_cage<3>(1);
  expect_refused("open at the edge", [&] { tetrahedralize_by_netgen(without_facet(cage, 4)); });
  EXPECT_THROW(tetrahedralize_by_netgen(cage, vertices<3>(-1)), OptionError);
  MeshingOptions<3> embedding;
  embedding.embedded_points = Vector<3>(0.1, 0.2, 0.3);
  expect_refused<OptionError>("given points", [&] { tetrahedralize_by_netgen(cage, embedding); });
  MeshingOptions<3> hasty = vertices<3>(300000);
  hasty.time_limit = 0.2;
  expect_refused("time limit of 0.2 s (time_limit)",
                 [&] { tetrahedralize_by_netgen(cage, hasty); });
  // One limit for all that is tried where a run fails.
  hasty.time_limit = 2;
  const double start = processor_seconds();
  EXPECT_THROW(tetrahedralize_by_netgen(cage, hasty), InputError);
  EXPECT_LT(processor_seconds() - start, 2 * hasty.time_limit);
  const Cage<3> crossing = join(box_cage<3>(Vector<3>(-1, -2, -1), Vector<3>(1, 2, 1)),
                                box_cage<3>(Vector<3>(-3, -0.5, -0.5), Vector<3>(3, 0.5, 0.5)));
  EXPECT_THROW(tetrahedralize_by_netgen(crossing), InputError);
}

TEST(TetrahedralizeByNetgenTest, RealCages) {
  if (!has_model("3d/horse_cage.obj")) GTEST_SKIP() << "the real models are absent";
  for (const auto* name : kRealCages3D) {
    SCOPED_TRACE(name);
    const Cage<3> cage = load_cage<3>(name);
    const DomainMesh<3> mesh = tetrahedralize_by_netgen(cage, vertices<3>(1500));
    expect_fills(cage, mesh, enclosed_measure(cage));
    expect_count(mesh, 1500, 0.15);
    EXPECT_TRUE(covers_edges(cage, mesh));
  }
}

}  // namespace
}  // namespace flbc::testing
