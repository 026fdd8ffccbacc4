// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/io/cage_io.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include <Eigen/Geometry>

namespace flbc::io {
namespace {

using Polygon = std::vector<Index>;

// The same for any first corner and orientation of a polygon: starts at the lowest number, and goes
// on to the lower of its neighbors. Second: whether the orientation is the other one.
std::pair<Polygon, bool> in_canonical_order(Polygon polygon) {
  const Index lowest = *std::min_element(polygon.begin(), polygon.end());
  std::pair<Polygon, bool> result;
  for (const bool is_reversed : {false, true}) {
    for (auto corner = polygon.begin(); corner != polygon.end(); ++corner) {
      if (*corner != lowest) continue;
      Polygon candidate(corner, polygon.end());
      candidate.insert(candidate.end(), polygon.begin(), corner);
      if (result.first.empty() || candidate < result.first) result = {candidate, is_reversed};
    }
    std::reverse(polygon.begin(), polygon.end());
  }
  return result;
}

// A polygon projected onto its best-fit plane.
class PolygonCutter {
 public:
  using Triangle = Eigen::Matrix<Index, 3, 1>;

  PolygonCutter(const std::vector<Vector<3>>& points, const Polygon& polygon)
      : points_(points), rest_(polygon) {
    const Vector<3>& origin = points[rest_[0]];
    for (std::size_t k = 1; k + 1 < rest_.size(); ++k) {
      normal_ += (points[rest_[k]] - origin).cross(points[rest_[k + 1]] - origin);
    }
    normal_.stableNormalize();
  }

  // Cuts a convex quadrilateral along its shorter diagonal, other convex polygons into a fan, and
  // the rest by ear clipping. An invalid polygon without ears is also cut into a fan.
  std::vector<Triangle> cut() {
    std::vector<Triangle> triangles;
    if (is_convex()) {
      // Diagonals that are equal up to rounding in a file: the one at the lowest number.
      constexpr double kShorter = 1 - 1e-5;
      if (rest_.size() == 4 && length(1, 3) < kShorter * length(0, 2)) {
        std::rotate(rest_.begin(), rest_.begin() + 1, rest_.end());
      }
    } else {
      cut_ears(triangles);
    }
    for (std::size_t k = 1; k + 1 < rest_.size(); ++k) {
      triangles.emplace_back(rest_[0], rest_[k], rest_[k + 1]);
    }
    return triangles;
  }

 private:
  std::size_t after(std::size_t corner, std::size_t steps = 1) const {
    return (corner + steps) % rest_.size();
  }

  double length(std::size_t a, std::size_t b) const {
    return (points_[rest_[a]] - points_[rest_[b]]).norm();
  }

  // Twice the signed area of a projected triangle.
  double area(Index a, Index b, Index c) const {
    return (points_[b] - points_[a]).cross(points_[c] - points_[a]).dot(normal_);
  }

  // Whether the polygon turns left at the corner after `corner`, by more than rounding.
  bool turns_left(std::size_t corner) const {
    const std::size_t next = after(corner), last = after(corner, 2);
    return area(rest_[corner], rest_[next], rest_[last]) >
           straight_ * length(corner, next) * length(next, last);
  }

  bool is_convex() const {
    for (std::size_t k = 0; k < rest_.size(); ++k) {
      if (!turns_left(k)) return false;
    }
    return true;
  }

  // Whether the corner after `corner` is an ear.
  bool is_ear(std::size_t corner) const {
    if (!turns_left(corner)) return false;
    const Index a = rest_[corner], b = rest_[after(corner)], c = rest_[after(corner, 2)];
    const auto is_left = [&](Index from, Index to, Index p) {
      return area(from, to, p) >= -straight_ * (points_[to] - points_[from]).squaredNorm();
    };
    return std::none_of(rest_.begin(), rest_.end(), [&](Index p) {
      return p != a && p != b && p != c && is_left(a, b, p) && is_left(b, c, p) && is_left(c, a, p);
    });
  }

  // Corners in line with others, up to rounding, would leave triangles without area. They count as
  // ears if there are no others. Continuing after the last ear avoids fans of slivers.
  void cut_ears(std::vector<Triangle>& triangles) {
    std::size_t corner = 0;
    for (std::size_t tried = 0; rest_.size() > 3 && tried < rest_.size(); ++tried) {
      corner = after(corner);
      if (tried + 1 == rest_.size() && straight_ > kRounding) {
        straight_ = kRounding;
        tried = 0;
      }
      if (!is_ear(corner)) continue;
      const std::size_t tip = after(corner);
      triangles.emplace_back(rest_[corner], rest_[tip], rest_[after(tip)]);
      rest_.erase(rest_.begin() + static_cast<std::ptrdiff_t>(tip));
      corner = tip < corner ? corner - 1 : corner;
      tried = 0;
    }
  }

  static constexpr double kRounding = 1e-9;

  const std::vector<Vector<3>>& points_;
  Polygon rest_;
  double straight_ = 1e-5;  // sines of smaller angles count as 0; files have six digits
  Vector<3> normal_ = Vector<3>::Zero();
};

}  // namespace

FacetList<3> cut_polygon(const std::vector<Vector<3>>& points, const std::vector<Index>& polygon) {
  if (polygon.size() == 3) {  // as below, but for a model of millions
    FacetList<3> triangle = Eigen::Map<const FacetList<3>>(polygon.data(), 3, 1);
    auto corners = triangle.reshaped();
    std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
    return triangle;
  }
  const auto [ordered, is_reversed] = in_canonical_order(polygon);
  const auto triangles = PolygonCutter(points, ordered).cut();
  FacetList<3> result(3, triangles.size());
  for (std::size_t t = 0; t < triangles.size(); ++t) result.col(t) = triangles[t];
  if (is_reversed) result.row(1).swap(result.row(2));
  return result;
}

FacetList<3> cut_polygon(const std::vector<Vector<3>>& corners) {
  std::vector<Index> polygon(corners.size());
  std::iota(polygon.begin(), polygon.end(), 0);
  return cut_polygon(corners, polygon);
}

}  // namespace flbc::io
