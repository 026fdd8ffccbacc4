// SPDX-License-Identifier: BSD-3-Clause
#include <chrono>

#include "flbc/meshing.h"
#include "support/mesh_checks.h"
#include "support/model_cages.h"
#include "support/test.h"

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
}

TEST(TriangulateTest, LoopsMayComeInAnyOrder) {
  const Cage<2> cage = join(box_cage<2>(0.5), box_cage<2>(1));  // the hole first
  expect_fills(cage, triangulate(cage, vertices<2>(500)), 3);
}

TEST(TriangulateTest, IslandsAndSeparateLoopsAreRefused) {
  const Cage<2> island = join(square_with_hole(false, false), box_cage<2>(0.25));
  EXPECT_THROW(triangulate(island, vertices<2>(500)), InputError);
  const Cage<2> apart = join(box_cage<2>({0, 0}, {1, 1}), box_cage<2>({2, 0}, {3, 1}));
  EXPECT_THROW(triangulate(apart, vertices<2>(500)), InputError);
}

TEST(TriangulateTest, DefectiveCagesAreRefused) {
  const Cage<2> box = box_cage<2>(1);
  const auto refusal = [](const Cage<2>& cage) {
    return message_of<InputError>([&] { triangulate(cage); });
  };
  EXPECT_NE(refusal(without_facet(box, 1)).find("open"), std::string::npos);
  Cage<2> crossing = box;  // corners 1 and 3 swapped: a figure of eight
  crossing.points.col(1).swap(crossing.points.col(3));
  EXPECT_NE(refusal(crossing).find("cross near (0, 0)"), std::string::npos);
  const Cage<2> overlapping = join(box, box_cage<2>({0, 0}, {3, 3}));
  EXPECT_NE(refusal(overlapping).find("cross"), std::string::npos);
}

TEST(TriangulateTest, EmbeddedPointsFollowTheControlPoints) {
  PointList<2> points{{0.1, -0.7, 0.123456789, -0.9999}, {-0.75, 0.7, 0.987654321, 0.1 + 0.2}};
  const Cage<2> cage = square_with_hole(false, true);
  for (Index count : {0, 2000}) {
    const DomainMesh<2> mesh = triangulate(cage, vertices<2>(count, points));
    expect_fills(cage, mesh, 3);
    expect_vertices<2>(mesh, cage.size(), points);
    if (count > 0) expect_count(mesh, count, 0.05);
  }
}

TEST(TriangulateTest, PointsThatCannotBeEmbedded) {
  const Cage<2> cage = square_with_hole(false, false);
  const auto refusal = [&](const Vector<2>& second) {
    PointList<2> points(2, 2);
    points << Vector<2>(0.75, 0.75), second;
    return message_of<InputError>([&] { triangulate(cage, vertices<2>(0, points)); });
  };
  EXPECT_NE(refusal({2, 0.5}).find("point 1 at (2, 0.5) cannot be embedded: it is outside"),
            std::string::npos);
  EXPECT_NE(refusal({0.1, 0.2}).find("outside"), std::string::npos) << "in the hole";
  EXPECT_NE(refusal({1, 0.2}).find("on the cage"), std::string::npos);
  EXPECT_NE(refusal({1, 1}).find("control point 3"), std::string::npos);
  EXPECT_NE(refusal({1, 1}).find("distinct points"), std::string::npos);
  EXPECT_NE(refusal({0.75, 0.75}).find("coincides with point 0"), std::string::npos);
  EXPECT_NE(refusal({std::nan(""), 0.75}).find("not finite"), std::string::npos);
}

TEST(TriangulateTest, OptionsOutOfRange) {
  const Cage<2> cage = square_with_hole(false, false);
  const Index minimum = triangulate(cage).num_vertices();
  const std::string text =
      message_of<TooFewVertices>([&] { triangulate(cage, vertices<2>(minimum / 2)); });
  EXPECT_NE(text.find("vertices: "), std::string::npos);
  EXPECT_NE(text.find(std::to_string(minimum)), std::string::npos);
  EXPECT_EQ(triangulate(cage, vertices<2>(minimum)).num_vertices(), minimum);
  EXPECT_THROW(triangulate(cage, vertices<2>(-1)), OptionError);
  EXPECT_THROW(triangulate(cage, vertices<2>(2000000000)), OptionError);
}

// Walls of a square ring that only millions of triangles of good shape would fill.
TEST(TriangulateTest, StopsAtTheTimeLimit) {
  const Cage<2> ring = join(box_cage<2>(1), box_cage<2>(1 - 1e-7));
  MeshingOptions<2> options;
  options.time_limit = 0.2;
  const auto start = std::chrono::steady_clock::now();
  const auto text = message_of<InputError>([&] { triangulate(ring, options); });
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
  EXPECT_NE(text.find("time limit of 0.2 s (time_limit)"), std::string::npos) << text;
  EXPECT_LT(seconds.count(), 5);
}

TEST(TriangulateTest, RunsAgreeBitByBit) {
  const Cage<2> cage = square_with_hole(true, false);
  expect_reproducible([&] { return triangulate(cage, vertices<2>(3000)); });
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

TEST(TriangulateTest, RealModelEmbedded) {
  if (!has_model("2d/woody_model.obj")) GTEST_SKIP() << "the real models are absent";
  const Cage<2> cage = load_cage<2>("2d/woody-control-edgeset.obj");
  const PointList<2> model = load_cage<2>("2d/woody_model.obj").points;
  const DomainMesh<2> mesh = triangulate(cage, vertices<2>(0, model));
  expect_fills(cage, mesh, std::abs(enclosed_measure(cage)));
  expect_vertices<2>(mesh, cage.size(), model);
}

}  // namespace
}  // namespace flbc::testing
