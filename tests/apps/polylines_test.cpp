// SPDX-License-Identifier: BSD-3-Clause
// Lines of vector pictures: joined and thinned, they cover what the segments cover.
#include "draw/polylines.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace flbc::draw {
namespace {

using Line = std::vector<Vector<2>>;

double distance(const Vector<2>& p, const Vector<2>& a, const Vector<2>& b) {
  const Vector<2> d = b - a;
  const double t =
      d.squaredNorm() > 0 ? std::clamp((p - a).dot(d) / d.squaredNorm(), 0.0, 1.0) : 0.0;
  return (p - a - t * d).norm();
}

double distance(const Vector<2>& p, const std::vector<Line>& lines) {
  double least = std::numeric_limits<double>::infinity();
  for (const auto& line : lines) {
    least = std::min(least, (p - line.front()).norm());
    for (std::size_t k = 0; k + 1 < line.size(); ++k) {
      least = std::min(least, distance(p, line[k], line[k + 1]));
    }
  }
  return least;
}

TEST(Polylines, CoverAllSegmentsAndNothingElse) {
  // A circle, a cross that shares its centre, and a dot, in disorder.
  std::vector<Segment> segments;
  constexpr int kCount = 400;
  const auto on_circle = [](int k) {
    const double angle = 2 * std::acos(-1.0) * (k % kCount) / kCount;
    return Vector<2>(20 * std::cos(angle), 20 * std::sin(angle));
  };
  for (int k = 0; k < kCount; ++k) {
    const int i = k * 171 % kCount;
    segments.push_back({on_circle(i + k % 2), on_circle(i + 1 - k % 2)});
  }
  for (const Vector<2>& end : {Vector<2>(9, 0), {-9, 1}, {0, 8}, {2, -9}}) {
    segments.push_back({end, {0, 0}});
    segments.push_back({{0, 0}, end});
  }
  segments.push_back({{30, 30}, {30, 30}});
  constexpr double kTolerance = 0.01;
  const auto lines = join_segments(segments, kTolerance);
  std::size_t points = 0;
  for (const auto& line : lines) points += line.size();
  EXPECT_LE(lines.size(), 6U);
  EXPECT_LT(points, 200U);
  for (const auto& segment : segments) {
    for (const double t : {0.0, 0.3, 1.0}) {
      EXPECT_LE(distance(segment.a + t * (segment.b - segment.a), lines), kTolerance + 1e-12);
    }
  }
  std::vector<Line> originals;
  for (const auto& segment : segments) originals.push_back({segment.a, segment.b});
  for (const auto& line : lines) {
    for (std::size_t k = 0; k + 1 < line.size(); ++k) {
      EXPECT_LE(distance(Vector<2>((line[k] + line[k + 1]) / 2), originals), kTolerance + 1e-12);
    }
  }
}

TEST(Polylines, StraightPiecesBecomeOne) {
  std::vector<Segment> segments;
  for (int k = 0; k < 100; ++k) segments.push_back({{0.1 * k, 0.3}, {0.1 * (k + 1), 0.3}});
  const auto lines = join_segments(segments, 1e-3);
  ASSERT_EQ(lines.size(), 1U);
  ASSERT_EQ(lines[0].size(), 2U);
  EXPECT_TRUE(join_segments({}, 1e-3).empty());
  const double nan = std::nan("");
  EXPECT_TRUE(join_segments({{{nan, 0}, {1, 1}}}, 1e-3).empty());
}

}  // namespace
}  // namespace flbc::draw
