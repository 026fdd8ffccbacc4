// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/meshing.h"
#include "support/mesh_checks.h"
#include "support/model_cages.h"
#include "support/processor_time.h"

namespace flbc::testing {
namespace {

double smallest_angle_in_degrees(const DomainMesh<2>& mesh) {
  double smallest = 180;
  for (Index cell = 0; cell < mesh.num_cells(); ++cell) {
    for (int k = 0; k < 3; ++k) {
      const Vector<2> apex = mesh.points.col(mesh.cells(k, cell));
      const Vector<2> u = Vector<2>(mesh.points.col(mesh.cells((k + 1) % 3, cell))) - apex;
      const Vector<2> v = Vector<2>(mesh.points.col(mesh.cells((k + 2) % 3, cell))) - apex;
      const double sine = u.x() * v.y() - u.y() * v.x();
      smallest = std::min(smallest, std::atan2(sine, u.dot(v)) * 180 / std::acos(-1.0));
    }
  }
  return smallest;
}

// A square of side 2 with a square hole of side 1, both loops in the directions given; the outer
// one has a collinear control point on its lowest edge.
Cage<2> square_with_hole(bool reverse_outer, bool reverse_hole) {
  const auto outer = loop(PointList<2>{{-1, 0.3, 1, 1, -1}, {-1, -1, -1, 1, 1}});
  const Cage<2> hole = box_cage<2>(0.5);
  return join(reverse_outer ? reversed(outer) : outer, reverse_hole ? reversed(hole) : hole);
}

TEST(TriangulateTest, AsFewVerticesAsQualityDemands) {
  const Cage<2> cage = box_cage<2>(1);
  const DomainMesh<2> mesh = triangulate(cage);
  expect_fills(cage, mesh, 4);
  EXPECT_EQ(mesh.num_vertices(), 4);  // two right triangles are good
}

TEST(TriangulateTest, CountAnglesAndCover) {
  for (double size : {1e-6, 1.0, 1e5}) {
    Cage<2> cage = box_cage<2>(size);
    for (Index count : {100, 1000, 10000}) {
      const DomainMesh<2> mesh = triangulate(cage, vertices<2>(count));
      expect_fills(cage, mesh, 4 * size * size);
      expect_count(mesh, count, 0.05);
      EXPECT_GT(smallest_angle_in_degrees(mesh), 20);
    }
  }
}

TEST(TriangulateTest, HolesInAnyDirectionAndCollinearControlPoints) {
  for (bool reverse_outer : {false, true}) {
    for (bool reverse_hole : {false, true}) {
      const Cage<2> cage = square_with_hole(reverse_outer, reverse_hole);
      for (Index count : {0, 1500}) {
        const DomainMesh<2> mesh = triangulate(cage, vertices<2>(count));
        expect_fills(cage, mesh, 3);
        if (count > 0) expect_count(mesh, count, 0.05);
      }
    }
  }
  const Cage<2> hole_first = join(box_cage<2>(0.5), box_cage<2>(1));
  expect_fills(hole_first, triangulate(hole_first, vertices<2>(500)), 3);
}

TEST(TriangulateTest, CrossingEdgesAreRefused) {
  const Cage<2> box = box_cage<2>(1);
  Cage<2> crossing = box;  // corners 1 and 3 swapped: a figure of eight
  crossing.points.col(1).swap(crossing.points.col(3));
  expect_refused("cross or touch near (0, 0)", [&] { triangulate(crossing); });
  const Cage<2> overlapping = join(box, box_cage<2>({0, 0}, {3, 3}));
  expect_refused("cross", [&] { triangulate(overlapping); });
}

TEST(TriangulateTest, TheFewestVerticesThatQualityDemandsAreEnough) {
  const Cage<2> cage = square_with_hole(false, false);
  const Index fewest = triangulate(cage).num_vertices();
  EXPECT_EQ(triangulate(cage, vertices<2>(fewest)).num_vertices(), fewest);
}

// Walls of a square ring that only millions of triangles of good shape would fill.
TEST(TriangulateTest, StopsAtTheTimeLimit) {
  const Cage<2> ring = join(box_cage<2>(1), box_cage<2>(1 - 1e-7));
  MeshingOptions<2> options;
  options.time_limit = 0.2;
  const double start = processor_seconds();
  expect_refused("time limit of 0.2 s (time_limit)", [&] { triangulate(ring, options); });
  EXPECT_LT(processor_seconds() - start, 5);
}

TEST(TriangulateTest, RealCages) {
  if (!has_model("2d/woody-control-edgeset.obj")) GTEST_SKIP() << "the real models are absent";
  struct Case {
    const char* name;
    Index count;
  };
  for (const Case& c : {Case{"woody", 10800}, Case{"LBClogo", 26800}, Case{"cactus", 12000}}) {
    const Cage<2> cage = load_cage<2>("2d/" + std::string(c.name) + "-control-edgeset.obj");
    const DomainMesh<2> mesh = triangulate(cage, vertices<2>(c.count));
    expect_fills(cage, mesh, std::abs(enclosed_measure(cage)));
    expect_count(mesh, c.count, 0.05);
    EXPECT_GT(smallest_angle_in_degrees(mesh), 20) << c.name;
    EXPECT_TRUE(covers_edges(cage, mesh)) << c.name;
  }
}

}  // namespace
}  // namespace flbc::testing
