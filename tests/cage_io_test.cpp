// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/io/cage_io.h"

#include <gtest/gtest.h>

#include "flbc/errors.h"

namespace flbc::io {
namespace {

PolygonSoup square() {
  PolygonSoup soup;
  soup.points = {{0, 0, 2}, {1, 0, 2}, {1, 1, 2}, {0, 1, 2}};
  return soup;
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

// A pyramid over a bent quadrangle, whose shorter diagonal is 1-3.
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

TEST(CageIo, RefusesWhatIsNoCage) {
  const auto refused = [](const PolygonSoup& soup, const std::string& words) {
    try {
      to_cage(soup, "file.obj");
      ADD_FAILURE() << "accepted, expected: " << words;
    } catch (const InputError& error) {
      const std::string message = error.what();
      EXPECT_EQ(message.find("file.obj: "), 0U) << message;
      EXPECT_NE(message.find(words), std::string::npos) << message;
    }
  };
  refused({}, "has no vertices");
  auto mixed = square();
  mixed.polygons = {{0, 1, 2}};
  mixed.polylines = {{0, 1}};
  refused(mixed, "both polygons and polylines");
  auto bent = square();
  bent.points[2].z() = 3;
  bent.polylines = {{0, 1, 2, 3, 0}};
  refused(bent, "vertex 2 at (1, 1, 3)");
}

}  // namespace
}  // namespace flbc::io
