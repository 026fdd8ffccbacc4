// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/io/cage_io.h"

#include <algorithm>
#include <set>

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "flbc/cage_facts.h"
#include "support/errors.h"

namespace flbc::io {
namespace {

PolygonSoup square() {
  PolygonSoup soup;
  soup.points = {{0, 0, 2}, {1, 0, 2}, {1, 1, 2}, {0, 1, 2}};
  return soup;
}

// The reentrant corner is in line with two others, up to the digits of a file.
TEST(CageIo, NoTriangleOfATurnedLIsFlat) {
  std::vector<Vector<3>> corners{{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}, {1, 2, 0}, {0, 2, 0}};
  for (int k = 0; k < 100; ++k) {
    const Eigen::AngleAxisd turn(0.37 * k, Vector<3>(1, 0.3 * k, -0.7).normalized());
    const double digits = std::pow(10.0, 6 + k % 10);
    std::vector<Vector<3>> turned;
    for (const auto& corner : corners) {
      turned.push_back((digits * (turn * corner)).array().round() / digits);
    }
    double area = 0;
    const auto triangles = cut_polygon(turned);
    for (const auto& t : triangles.colwise()) {
      const double own =
          (turned[t(1)] - turned[t(0)]).cross(turned[t(2)] - turned[t(0)]).norm() / 2;
      EXPECT_GT(own, 0.4) << k;
      area += own;
    }
    EXPECT_NEAR(area, 3, 1e-5);
  }
}

TEST(CageIo, PointsPolylineAndPolygonMakeTheSameFlatCage) {
  auto polyline = square();
  polyline.polylines = {{0, 1, 2, 3, 0}};
  auto segments = square();
  segments.polylines = {{0, 1}, {1, 2}, {2, 3}, {3, 0}};
  auto polygon = square();
  polygon.polygons = {{0, 1, 2, 3}};
  for (const auto& soup : {square(), polyline, segments, polygon}) {
    const auto cage = std::get<Cage<2>>(to_cage(soup, "square.obj"));
    EXPECT_EQ(cage.size(), 4);
    ASSERT_EQ(cage.facets.cols(), 4);
    for (Index e = 0; e < 4; ++e) {
      EXPECT_EQ(cage.facets(0, e), e);
      EXPECT_EQ(cage.facets(1, e), (e + 1) % 4);
    }
    EXPECT_TRUE(find_defects(cage).empty());
  }
}

TEST(CageIo, VerticesInsideOfAPlanarMeshAreNoControlPoints) {
  PolygonSoup soup;
  soup.points = {{0, 0, 0}, {1, 1, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}};
  soup.polygons = {{0, 2, 1}, {2, 3, 1}, {3, 4, 1}, {4, 0, 1}};
  const auto cage = std::get<Cage<2>>(to_cage(soup, "mesh.obj"));
  ASSERT_EQ(cage.size(), 4);
  EXPECT_EQ(cage.points.col(1), Vector<2>(2, 0));
  EXPECT_TRUE(find_defects(cage).empty());
  const auto outline = control_polygons<2>(soup);
  EXPECT_EQ(outline.points.size(), 4u);
  EXPECT_EQ(outline.polygons, (std::vector<std::vector<Index>>{{0, 1, 2, 3}}));
}

// A pyramid over a bent quadrilateral, whose shorter diagonal is 1-3.
TEST(CageIo, QuadranglesAreCutAlongTheShorterDiagonal) {
  PolygonSoup soup;
  soup.points = {{-2, 0, 0}, {0, -1, 0}, {2, 0, 0}, {0, 1, 0}, {0, 0, 3}};
  soup.polygons = {{0, 3, 2, 1}, {0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}};
  const auto cage = std::get<Cage<3>>(to_cage(soup, "pyramid.obj"));
  ASSERT_EQ(cage.facets.cols(), 6);
  for (int f = 0; f < 2; ++f) {
    EXPECT_TRUE((cage.facets.col(f).array() == 1).any());
    EXPECT_TRUE((cage.facets.col(f).array() == 3).any());
  }
  EXPECT_TRUE(find_defects(cage).empty());
}

// Area of the triangles, and whether all are seen from the same side.
double area_seen_from_above(const PolygonSoup& soup) {
  const auto cage = std::get<Cage<3>>(to_cage(soup, "file.obj"));
  double sum = 0;
  for (Index f = 0; f < cage.facets.cols(); ++f) {
    const Vector<3> a = cage.points.col(cage.facets(0, f));
    const Vector<3> b = cage.points.col(cage.facets(1, f));
    const Vector<3> c = cage.points.col(cage.facets(2, f));
    const Vector<3> normal = (b - a).cross(c - a) / 2;
    EXPECT_GT(normal.z(), 0) << "triangle " << f;
    sum += normal.z();
  }
  return sum;
}

// From whichever corner they start; the second polygon only makes a surface of it.
TEST(CageIo, PolygonsThatAreNotConvexAreCutInside) {
  const std::pair<std::vector<Vector<3>>, double> cases[] = {
      {{{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}, {1, 2, 0}, {0, 2, 0}}, 3},  // an L
      // an arrow head, whose shorter diagonal is outside
      {{{0, 3, 0}, {-0.5, 0, 0}, {0, 1, 0}, {0.5, 0, 0}}, 1},
      {{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}}, 4},  // with a straight corner
      {{{1, 1, 0}, {1, 3, 0}, {0, 3, 0}, {0, 0, 0}, {3, 0, 0}, {3, 3, 0}, {2, 3, 0}, {2, 1, 0}},
       7},  // a U
  };
  for (const auto& [outline, area] : cases) {
    const auto n = static_cast<Index>(outline.size());
    for (Index start = 0; start < n; ++start) {
      PolygonSoup soup;
      soup.points = outline;
      soup.points.insert(soup.points.end(), {{9, 0, 1}, {10, 0, 1}, {9, 1, 1}});
      soup.polygons = {{}, {n, n + 1, n + 2}};
      for (Index k = 0; k < n; ++k) soup.polygons[0].push_back((start + k) % n);
      EXPECT_NEAR(area_seen_from_above(soup), area + 0.5, 1e-12) << n << " from " << start;
    }
  }
}

std::set<std::set<Index>> undirected_triangles(const PolygonSoup& soup) {
  std::set<std::set<Index>> result;
  const auto cage = std::get<Cage<3>>(to_cage(soup, "file.obj"));
  for (const auto& facet : cage.facets.colwise()) result.insert({facet[0], facet[1], facet[2]});
  EXPECT_EQ(result.size(), cage.facets.cols());
  return result;
}

TEST(CageIo, ReExportedPolygonsAreCutAlike) {
  // Prisms on a square, a regular hexagon, a notched and a bent polygon. All diagonals of the sides
  // are equal but for the digits of a file.
  const std::vector<std::vector<Vector<2>>> grounds = {
      {{0, 0}, {1, 0}, {1, 1}, {0, 1}},
      {{2, 0}, {1, 1.732051}, {-1, 1.732051}, {-2, 0}, {-1, -1.732051}, {1, -1.732051}},
      {{0, 0}, {4, 0}, {4, 2}, {2, 1}, {0, 2}},
      {{0, 0}, {3, 0}, {3, 3}, {2, 3}, {2, 1}, {0, 1}}};
  for (const auto& ground : grounds) {
    PolygonSoup soup;
    soup.polygons.resize(2);
    const auto n = static_cast<Index>(ground.size());
    for (Index k = 0; k < 2 * n; ++k) {
      soup.points.emplace_back(ground[k % n].x(), ground[k % n].y(),
                               k < n ? 0 : 2 + 1e-6 * (k % 3));
      soup.polygons[k / n].push_back(k);
    }
    std::reverse(soup.polygons[0].begin(), soup.polygons[0].end());
    for (Index k = 0; k < n; ++k) {
      soup.polygons.push_back({k, (k + 1) % n, n + (k + 1) % n, n + k});
    }
    const auto expected = undirected_triangles(soup);
    for (int turn = 0; turn < 2 * n; ++turn) {
      auto& polygons = soup.polygons;
      for (auto& polygon : polygons) {
        std::rotate(polygon.begin(), polygon.begin() + 1, polygon.end());
        if (turn % 3 == 0) std::reverse(polygon.begin(), polygon.end());
      }
      std::rotate(polygons.begin(), polygons.begin() + 2, polygons.end());
      EXPECT_EQ(undirected_triangles(soup), expected) << n << " corners, turn " << turn;
    }
  }
}

TEST(CageIo, PolygonsInThePlaneStandForWhatBoundsThem) {
  // A frame of four quadrilaterals around a hole.
  PolygonSoup frame;
  frame.points = {{0, 0, 2}, {3, 0, 2}, {3, 3, 2}, {0, 3, 2},
                  {1, 1, 2}, {2, 1, 2}, {2, 2, 2}, {1, 2, 2}};
  for (Index k = 0; k < 4; ++k) {
    frame.polygons.push_back({k, (k + 1) % 4, 4 + (k + 1) % 4, 4 + k});
  }
  const auto cage = std::get<Cage<2>>(to_cage(frame, "frame.obj"));
  EXPECT_TRUE(find_defects(cage).empty());
  EXPECT_EQ(cage.facets.cols(), 8);
  EXPECT_DOUBLE_EQ(measure_cage(cage).measure, 9 - 1);
  EXPECT_EQ(measure_cage(cage).holes, 1);
  // Where the polygon is drawn as well, it decides.
  frame.polylines = {{0, 1, 2, 3, 0}};
  const auto outline = std::get<Cage<2>>(to_cage(frame, "frame.obj"));
  EXPECT_EQ(outline.facets.cols(), 4);
}

// Its defects are then those of a surface, and not of edges that it does not have.
TEST(CageIo, ClosedSurfaceThatLiesFlatIsASurface) {
  auto flat = square();
  flat.polygons = {{0, 1, 2}, {0, 2, 3}, {0, 2, 1}, {0, 3, 2}};
  const auto cage = std::get<Cage<3>>(to_cage(flat, "flat.obj"));
  EXPECT_EQ(cage.facets.cols(), 4);
  flbc::testing::expect_piece(find_defects(cage).front().message, "in one plane");
}

TEST(CageIo, RefusesWhatIsNoCage) {
  const auto refused = [](const PolygonSoup& soup, const std::string& words) {
    testing::expect_error<InputError>([&] { to_cage(soup, "file.obj"); }, {"file.obj: " + words});
  };
  refused({}, "has no vertices");
  PolygonSoup scan;
  scan.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  refused(scan, "has no facets and no polylines");
  auto mixed = square();
  mixed.polygons = {{0, 1, 2}};
  mixed.polylines = {{0, 1}};
  mixed.points[3].z() = 1;
  refused(mixed, "has both polygons and polylines");
  auto bent = square();
  bent.points[2].z() = 3;
  bent.polylines = {{0, 1, 2, 3, 0}};
  refused(bent, "vertex 2 at (1, 1, 3)");
  auto upright = square();
  upright.polygons = {{0, 1, 2, 3}};
  for (auto& point : upright.points) std::swap(point.y(), point.z());
  refused(upright, "is flat, but a 2D cage must have the same z everywhere; all vertices have the");
}

}  // namespace
}  // namespace flbc::io
