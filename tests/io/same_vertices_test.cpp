// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/io/same_vertices.h"

#include "flbc/io/cage_io.h"
#include "support/cages_of_all_kinds.h"
#include "support/refined_sample.h"

namespace flbc::testing {
namespace {

using io::PolygonSoup;

template <int Dim>
PolygonSoup polygons_of(const Cage<Dim>& cage) {
  PolygonSoup soup;
  for (const auto& point : cage.points.colwise()) {
    soup.points.push_back(Vector<3>::Zero());
    soup.points.back().template head<Dim>() = point;
  }
  for (const auto& facet : cage.facets.colwise()) {
    (Dim == 2 ? soup.polylines : soup.polygons).emplace_back(facet.begin(), facet.end());
  }
  return io::control_polygons<Dim>(soup);
}

// Vertex v gets number numbers[v]; the polygons come in another order and start elsewhere.
PolygonSoup renumbered(const PolygonSoup& soup, const std::vector<Index>& numbers,
                       std::mt19937& random) {
  PolygonSoup result = soup;
  for (std::size_t v = 0; v < numbers.size(); ++v) result.points[numbers[v]] = soup.points[v];
  for (auto& polygon : result.polygons) {
    for (Index& vertex : polygon) vertex = numbers[vertex];
    std::rotate(polygon.begin(), polygon.begin() + random() % polygon.size(), polygon.end());
  }
  std::shuffle(result.polygons.begin(), result.polygons.end(), random);
  return result;
}

std::set<std::set<Index>> edges_of(const PolygonSoup& soup) {
  std::set<std::set<Index>> edges;
  for (const auto& polygon : soup.polygons) {
    for (std::size_t k = 0; k < polygon.size(); ++k) {
      edges.insert({polygon[k], polygon[(k + 1) % polygon.size()]});
    }
  }
  return edges;
}

std::vector<Index> in_order(std::size_t count) {
  std::vector<Index> numbers(count);
  std::iota(numbers.begin(), numbers.end(), 0);
  return numbers;
}

// Moves every vertex by less than half of the way to its neighbors.
void deform(PolygonSoup& soup, std::mt19937& random) {
  std::uniform_real_distribution<double> shift(-0.02, 0.02);
  for (auto& point : soup.points) point += Vector<3>(shift(random), shift(random), 0);
}

TEST_IN_2D_AND_3D(SameVertices, ARenumberingIsFoundInAllShapes) {
  std::mt19937 random(7);
  int num_renumbered = 0;
  auto all = cages<Dim>();
  all.push_back(with_fine_cage<Dim>(Shape::kRing, 3, 3));
  for (const auto& sample : all) {
    SCOPED_TRACE(sample.name);
    const auto rest = polygons_of(sample.cage);
    auto moved = rest;
    deform(moved, random);
    auto numbers = in_order(rest.points.size());
    auto pose = moved;
    // Symmetries of the polygons, among them all renumberings of a simplex, are no renumberings.
    for (int k = 0; k < 20 && edges_of(pose) == edges_of(rest); ++k) {
      std::shuffle(numbers.begin(), numbers.end(), random);
      pose = renumbered(moved, numbers, random);
    }
    if (edges_of(pose) == edges_of(rest)) continue;
    ++num_renumbered;
    EXPECT_EQ(io::find_same_vertices(rest, "rest", pose, "pose").numbers, numbers);
    for (auto& polygon : pose.polygons) std::reverse(polygon.begin(), polygon.end());
    const auto same = io::find_same_vertices(rest, "rest", pose, "pose");
    EXPECT_EQ(same.numbers, numbers);
    EXPECT_TRUE(same.are_renumbered);
  }
  EXPECT_GE(num_renumbered, 5);
}

// However far the vertices move, and in whichever order the file has its polygons.
TEST_IN_2D_AND_3D(SameVertices, TheNumbersStayWhereThePolygonsAreTheSame) {
  std::mt19937 random(11);
  for (const auto& sample : cages<Dim>()) {
    SCOPED_TRACE(sample.name);
    const auto rest = polygons_of(sample.cage);
    const auto numbers = in_order(rest.points.size());
    auto pose = renumbered(rest, numbers, random);
    for (auto& point : pose.points) point = Vector<3>::Random();
    const auto same = io::find_same_vertices(rest, "rest", pose, "pose");
    EXPECT_EQ(same.numbers, numbers);
    EXPECT_FALSE(same.are_renumbered);
    pose.polygons.clear();  // mere points
    EXPECT_EQ(io::find_same_vertices(rest, "rest", pose, "pose").numbers, numbers);
  }
}

PolygonSoup cube() {
  PolygonSoup soup;
  for (int v = 0; v < 8; ++v) soup.points.emplace_back(v & 1, v >> 1 & 1, v >> 2);
  soup.polygons = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                   {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  return soup;
}

// \param corner  0 or 1, by which diagonal
PolygonSoup cut_cube(int corner) {
  auto soup = cube();
  soup.polygons.clear();
  for (auto quad : cube().polygons) {
    std::rotate(quad.begin(), quad.begin() + corner, quad.end());
    soup.polygons.push_back({quad[0], quad[1], quad[2]});
    soup.polygons.push_back({quad[0], quad[2], quad[3]});
  }
  return soup;
}

TEST(SameVertices, PolygonsMayBeDividedInOtherWays) {
  const std::vector<PolygonSoup> all{cube(), cut_cube(0), cut_cube(1)};
  for (const auto& rest : all) {
    for (const auto& pose : all) {
      EXPECT_FALSE(io::find_same_vertices(rest, "rest", pose, "pose").are_renumbered);
    }
  }
}

TEST(SameVertices, OfAllMatchesTheNearestIsTaken) {
  std::mt19937 random(3);
  const auto rest = cube();
  auto moved = rest;
  for (auto& point : moved.points) point.z() *= 1.5;
  const std::vector<Index> numbers{3, 0, 7, 6, 1, 5, 4, 2};
  const auto pose = renumbered(moved, numbers, random);
  EXPECT_EQ(io::find_same_vertices(rest, "rest", pose, "pose").numbers, numbers);
}

TEST(SameVertices, OtherVerticesAreRefused) {
  std::mt19937 random(5);
  const auto refused = [](const PolygonSoup& rest, const PolygonSoup& pose,
                          const std::string& words) {
    expect_refused(words, [&] { io::find_same_vertices(rest, "rest.obj", pose, "pose.obj"); });
  };
  auto pose = cube();
  pose.points.pop_back();
  refused(cube(), pose, "pose.obj: has 7 vertices, but rest.obj has 8");
  auto other = cube();
  other.polygons[0] = {0, 2, 5};
  refused(cube(), other, "pose.obj: face 0 joins vertices 0 2 5, but rest.obj has no such face");
  auto open = cube();
  open.polygons.pop_back();
  refused(cube(), open, "rest.obj: face 5 joins vertices 1 3 7 5, but pose.obj has no such face");
  // Where all points are one, no match is nearer than another.
  auto collapsed = renumbered(cube(), {3, 0, 7, 6, 1, 5, 4, 2}, random);
  for (auto& point : collapsed.points) point.setZero();
  refused(cube(), collapsed, "several matches move them equally far");
}

}  // namespace
}  // namespace flbc::testing
