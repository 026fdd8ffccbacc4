// SPDX-License-Identifier: BSD-3-Clause

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

void expect_refused_pose(const PolygonSoup& rest, const PolygonSoup& pose,
                         const std::string& words) {
  expect_refused(words, [&] { io::check_same_vertices(rest, "rest.obj", pose, "pose.obj"); });
}

TEST_IN_2D_AND_3D(SameVertices, OtherNumbersAreRefused) {
  std::mt19937 random(7);
  int num_renumbered = 0;
  auto all = cages<Dim>();
  all.push_back(with_fine_cage<Dim>(Shape::kRing, 3, 3));
  for (const auto& sample : all) {
    SCOPED_TRACE(sample.name);
    const auto rest = polygons_of(sample.cage);
    auto numbers = in_order(rest.points.size());
    auto pose = rest;
    // Symmetries of the polygons, among them all renumberings of a simplex, are no renumberings.
    for (int k = 0; k < 20 && edges_of(pose) == edges_of(rest); ++k) {
      std::shuffle(numbers.begin(), numbers.end(), random);
      pose = renumbered(rest, numbers, random);
    }
    if (edges_of(pose) == edges_of(rest)) continue;
    ++num_renumbered;
    expect_refused_pose(rest, pose, "export it with its order of vertices");
  }
  EXPECT_GE(num_renumbered, 5);
}

// However far the vertices move, and in whichever order and direction the file has its polygons.
TEST_IN_2D_AND_3D(SameVertices, TheSamePolygonsPass) {
  std::mt19937 random(11);
  for (const auto& sample : cages<Dim>()) {
    SCOPED_TRACE(sample.name);
    const auto rest = polygons_of(sample.cage);
    auto pose = renumbered(rest, in_order(rest.points.size()), random);
    for (auto& point : pose.points) point = Vector<3>::Random();
    for (auto& polygon : pose.polygons) std::reverse(polygon.begin(), polygon.end());
    EXPECT_NO_THROW(io::check_same_vertices(rest, "rest", pose, "pose"));
    pose.polygons.clear();  // mere points
    EXPECT_NO_THROW(io::check_same_vertices(rest, "rest", pose, "pose"));
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
      EXPECT_NO_THROW(io::check_same_vertices(rest, "rest", pose, "pose"));
    }
  }
}

TEST(SameVertices, OtherVerticesAreRefused) {
  auto pose = cube();
  pose.points.pop_back();
  expect_refused_pose(cube(), pose, "pose.obj: has 7 vertices, but rest.obj has 8");
  auto other = cube();
  other.polygons[0] = {0, 2, 5};
  expect_refused_pose(cube(), other,
                      "pose.obj: face 0 joins vertices 0 2 5, but rest.obj has no such face");
  auto open = cube();
  open.polygons.pop_back();
  expect_refused_pose(cube(), open,
                      "rest.obj: face 5 joins vertices 1 3 7 5, but pose.obj has no such face");
}

}  // namespace
}  // namespace flbc::testing
