// SPDX-License-Identifier: BSD-3-Clause
#include "coordinates/polygon_triangulation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <utility>

#include "base/messages.h"
#include "flbc/errors.h"

namespace flbc {
namespace {

using Edge = std::pair<Index, Index>;  // directed

class Triangulator {
 public:
  explicit Triangulator(const Cage<2>& cage) : points_(cage.points) {
    for (const auto& edge : cage.facets.colwise()) {
      open_.insert({edge[0], edge[1]});
      walls_.push_back({edge[0], edge[1]});
    }
  }

  // Adds the triangle to the left of an open edge until there is none.
  std::vector<std::array<Index, 3>> run() {
    std::vector<std::array<Index, 3>> triangles;
    while (!open_.empty()) {
      const auto [a, b] = *open_.begin();
      open_.erase(open_.begin());
      const Index c = apex(a, b);
      triangles.push_back({a, b, c});
      close({b, c});
      close({c, a});
    }
    return triangles;
  }

 private:
  // Twice the area of a triangle; 0 if its corners are on a line up to rounding.
  double orientation(Index a, Index b, Index c) const {
    constexpr double kFlat = 1e-13;
    const Vector<2> u = points_.col(b) - points_.col(a), v = points_.col(c) - points_.col(a);
    const double area = u.x() * v.y() - u.y() * v.x();
    return std::abs(area) > kFlat * u.norm() * v.norm() ? area : 0;
  }

  // Whether two points are on different sides of a line, and neither is on it.
  bool parts(Index a, Index b, Index c, Index d) const {
    const double one = orientation(a, b, c), other = orientation(a, b, d);
    return (one > 0 && other < 0) || (one < 0 && other > 0);
  }

  void close(const Edge& edge) {
    if (open_.erase(edge) > 0) return;
    open_.insert({edge.second, edge.first});
    walls_.push_back(edge);
  }

  bool is_visible(Index a, Index b) const {
    return std::none_of(walls_.begin(), walls_.end(), [&](const Edge& wall) {
      const auto& [c, d] = wall;
      if (a == c || a == d || b == c || b == d) return false;
      return parts(a, b, c, d) && parts(c, d, a, b);
    });
  }

  // The visible vertex that sees the edge under the largest angle: no other one is in the
  // circumcircle.
  Index apex(Index a, Index b) const {
    std::vector<std::pair<double, Index>> candidates;  // cotangent of the angle
    for (Index c = 0; c < points_.cols(); ++c) {
      const double area = orientation(a, b, c);
      if (c == a || c == b || !(area > 0)) continue;
      const double dot = (points_.col(a) - points_.col(c)).dot(points_.col(b) - points_.col(c));
      candidates.emplace_back(dot / area, c);
    }
    std::sort(candidates.begin(), candidates.end());
    for (const auto& [cotangent, c] : candidates) {
      if (is_visible(a, c) && is_visible(b, c)) return c;
    }
    throw InputError("the cage cannot be triangulated at its edge from control point " +
                     std::to_string(a) + " to " + std::to_string(b) +
                     "; check it for self-intersections");
  }

  const PointList<2>& points_;
  std::set<Edge> open_;      // the interior to their left has no triangle yet
  std::vector<Edge> walls_;  // cage edges and edges of triangles
};

}  // namespace

PolygonTriangulation triangulate_polygon(const Cage<2>& cage) {
  const auto triangles = Triangulator(cage).run();
  std::map<Edge, Index> apex_of;
  for (const auto& t : triangles) {
    for (int k = 0; k < 3; ++k) apex_of[{t[(k + 1) % 3], t[(k + 2) % 3]}] = t[k];
  }
  PolygonTriangulation result;
  const auto count = static_cast<Index>(triangles.size());
  result.triangles.resize(3, count);
  result.opposite.resize(3, count);
  for (Index t = 0; t < count; ++t) {
    const auto& corners = triangles[t];
    for (int k = 0; k < 3; ++k) {
      result.triangles(k, t) = corners[k];
      const auto neighbor = apex_of.find({corners[(k + 2) % 3], corners[(k + 1) % 3]});
      result.opposite(k, t) = neighbor == apex_of.end() ? -1 : neighbor->second;
    }
  }
  return result;
}

}  // namespace flbc
