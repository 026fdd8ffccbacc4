// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/meshing.h"
#include "flbc/nested_mesh.h"
#include "support/child_processes.h"
#include "support/mesh_checks.h"
#include "support/model_cages.h"
#include "support/processor_time.h"

namespace flbc::testing {
namespace {

// Circumradius over shortest edge, largest over the cells: what TetGen is asked to bound.
double worst_radius_edge_ratio(const DomainMesh<3>& mesh) {
  double worst = 0;
  for (Index cell = 0; cell < mesh.num_cells(); ++cell) {
    const Vector<3> origin = mesh.points.col(mesh.cells(0, cell));
    Eigen::Matrix3d edges;
    for (int k = 0; k < 3; ++k) {
      edges.row(k) = (mesh.points.col(mesh.cells(k + 1, cell)) - origin).transpose();
    }
    const Vector<3> half_squares = edges.rowwise().squaredNorm() / 2;
    const double radius = (edges.inverse() * half_squares).norm();
    double shortest = edges.row(0).norm();
    for (int k = 0; k < 3; ++k) {
      shortest =
          std::min({shortest, edges.row(k).norm(), (edges.row(k) - edges.row((k + 1) % 3)).norm()});
    }
    worst = std::max(worst, radius / shortest);
  }
  return worst;
}

TEST(TetrahedralizeTest, CountAndCover) {
  for (double size : {1e-6, 1.0, 1e5}) {
    const Cage<3> cage = box_cage<3>(size);
    for (Index count : {0, 300, 5000}) {
      if (count == 5000 && size != 1) continue;
      const DomainMesh<3> mesh = tetrahedralize(cage, vertices<3>(count));
      expect_fills(cage, mesh, 8 * size * size * size);
      if (count > 0) expect_count(mesh, count, 0.10);
      // A regular cage's count jumps unless the cells' shapes are bounded less tightly.
      const auto coarse = coarse_mesh(mesh);
      EXPECT_LT(worst_radius_edge_ratio(coarse ? coarse->mesh : mesh), count == 0 ? 1.5 : 1.9);
    }
  }
}

TEST(TetrahedralizeTest, TiltedBoxesWhoseCoplanarFacetsAreNotQuiteCoplanarInDoubles) {
  int num_covered = 0;
  for (int k = 1; k <= 12; ++k) {
    Cage<3> cage = box_cage<3>(1);
    const Eigen::AngleAxisd turn(0.37 * k, Vector<3>(1, 0.3 * k, -0.7).normalized());
    cage.points = turn * Vector<3>(1, 0.6, 0.8).asDiagonal() * cage.points;
    const DomainMesh<3> mesh = tetrahedralize(cage, vertices<3>(1000));
    expect_fills(cage, mesh, 8 * 0.6 * 0.8);
    expect_count(mesh, 1000, 0.10);
    num_covered += covers_edges(cage, mesh);
  }
  EXPECT_GE(num_covered, 10);  // TetGen cannot always
}

// TetGen joins the facets of a base, which are coplanar up to rounding, and then crashes on some
// turns; with all edges it does not.
TEST(TetrahedralizeTest, TurnedPrismsWhoseBasesAreNotQuiteFlatAreFilled) {
  for (int k = 0; k < 12; ++k) {
    const Index sides = 8 + 4 * (k % 3);
    Cage<3> cage{PointList<3>(3, 2 * sides), FacetList<3>(3, 4 * sides - 4)};
    Index next = 0;
    const auto add = [&](Index a, Index b, Index c) { cage.facets.col(next++) << a, b, c; };
    for (Index i = 0; i < sides; ++i) {
      const double angle = 2 * std::acos(-1.0) * i / sides;
      const Index j = (i + 1) % sides;
      cage.points.col(i) << std::cos(angle), std::sin(angle), 0;
      cage.points.col(sides + i) << std::cos(angle), std::sin(angle), 5;
      if (i > 0 && j > 0) add(0, j, i);
      if (i > 0 && j > 0) add(sides, sides + i, sides + j);
      add(i, j, sides + j);
      add(i, sides + j, sides + i);
    }
    const double volume = 2.5 * sides * std::sin(2 * std::acos(-1.0) / sides);
    const Eigen::AngleAxisd turn(0.37 * k, Vector<3>(1, 0.3 * k, -0.7).normalized());
    const PointList<3> turned = turn.toRotationMatrix() * cage.points;
    cage.points = (1e10 * turned).array().round() / 1e10;  // as a file has them
    expect_fills(cage, tetrahedralize(cage), volume);
  }
}

TEST(TetrahedralizeTest, ATurnedCageInAnotherOrderGetsTheSameMesh) {
  const auto cage = box_cage<3>(1);
  auto turned = cage;
  turned.facets.rowwise().reverseInPlace();
  turned.facets.row(1).swap(turned.facets.row(2));
  const auto one = tetrahedralize(cage, vertices<3>(500));
  const auto other = tetrahedralize(turned, vertices<3>(500));
  EXPECT_EQ(one.points, other.points);
  EXPECT_EQ(one.cells, other.cells);
}

TEST(TetrahedralizeTest, CavitiesStayEmptyWhateverTheirOrientationAndOrder) {
  const Cage<3> box = box_cage<3>(1), cavity = box_cage<3>(0.5);
  const Cage<3> second = box_cage<3>(0.7, 0.9);
  for (const Cage<3>& cage : {join(box, cavity), join(box, reversed(cavity)), join(cavity, box)}) {
    for (Index count : {0, 2000}) {
      const DomainMesh<3> mesh = tetrahedralize(cage, vertices<3>(count));
      expect_fills(cage, mesh, 7);
      if (count > 0) expect_count(mesh, count, 0.10);
    }
  }
  const Cage<3> two = join(join(box, cavity), second);
  expect_fills(two, tetrahedralize(two), 7 - 0.008);
}

TEST(TetrahedralizeTest, SelfIntersectionsGiveAnErrorAndTheProcessSurvives) {
  const Cage<3> crossing = join(box_cage<3>(Vector<3>(-1, -2, -1), Vector<3>(1, 2, 1)),
                                box_cage<3>(Vector<3>(-3, -0.5, -0.5), Vector<3>(3, 0.5, 0.5)));
  expect_error<InputError>([&] { tetrahedralize(crossing); }, {"TetGen", "intersect"});
  EXPECT_FALSE(has_child());
  expect_fills(box_cage<3>(1), tetrahedralize(box_cage<3>(1)), 8);  // and still works
}

TEST(TetrahedralizeTest, TimeLimit) {
  MeshingOptions<3> options = vertices<3>(2000000);
  options.time_limit = 0.3;
  const double start = processor_seconds();
  expect_refused("time limit of 0.3 s", [&] { tetrahedralize(box_cage<3>(1), options); });
  EXPECT_LT(processor_seconds() - start, 20);
  EXPECT_FALSE(has_child());
}

TEST(TetrahedralizeTest, AThinWallIsNamedWhereMeshingDoesNotEnd) {
  const Cage<3> flat = box_cage<3>(Vector<3>(-1, -1, -1e-4), Vector<3>(1, 1, 1e-4));
  MeshingOptions<3> options = vertices<3>(4000);
  options.time_limit = 0.5;
  expect_error<InputError>(
      [&] { tetrahedralize(flat, options); },
      {"thinnest between control point", "7.1e-05 of its size"});  // 2e-4 / sqrt(8)
}

// Facets that are joined where they are coplanar take more vertices in a rod than those left alone.
TEST(TetrahedralizeTest, MoreVerticesThanTheFewestAreNeverTooFew) {
  const Cage<3> rod = box_cage<3>({0, 0, 0}, {1, 0.001, 0.001});
  const Index fewest = tetrahedralize(rod).num_vertices();
  for (const Index count : {fewest, 2 * fewest}) {
    const DomainMesh<3> mesh = tetrahedralize(rod, vertices<3>(count));
    expect_fills(rod, mesh, 1e-6);
    EXPECT_TRUE(covers_edges(rod, mesh));
    EXPECT_NEAR(mesh.num_vertices(), count, 0.3 * count);  // many of its cells are halved at once
  }
}

TEST(TetrahedralizeTest, IsRefinedWhereTheCageAllowsACoarserMesh) {
  const Cage<3> cage = box_cage<3>(Vector<3>(0, 0, 0), Vector<3>(1, 2, 1));
  const auto coarsest = tetrahedralize(cage);
  EXPECT_FALSE(coarse_mesh(coarsest));
  for (const Index count : {500, 3000}) {
    const auto mesh = tetrahedralize(cage, vertices<3>(count));
    const auto coarse = coarse_mesh(mesh);
    ASSERT_TRUE(coarse);
    expect_fills(cage, coarse->mesh, 2);
    expect_fills(cage, mesh, 2);
    EXPECT_EQ(mesh.points.leftCols(cage.size()), cage.points);
  }
}

TEST(TetrahedralizeTest, RealCages) {
  if (!has_model("3d/horse_cage.obj")) GTEST_SKIP() << "the real models are absent";
  for (const auto* name : kRealCages3D) {
    const Cage<3> cage = load_cage<3>(name);
    const DomainMesh<3> mesh = tetrahedralize(cage, vertices<3>(5900));
    expect_fills(cage, mesh, enclosed_measure(cage));
    expect_count(mesh, 5900, 0.10);
    EXPECT_TRUE(covers_edges(cage, mesh)) << name;
  }
}

TEST(TetrahedralizeTest, RealCagesThatCrashTetgen) {
  if (!has_model("defective/self_intersecting_cage.obj")) {
    GTEST_SKIP() << "the real models are absent";
  }
  for (const char* name : {"self_intersecting_cage.obj", "genus1_self_intersecting_cage.obj"}) {
    EXPECT_THROW(tetrahedralize(load_cage<3>("defective/" + std::string(name))), InputError);
  }
}

}  // namespace
}  // namespace flbc::testing
