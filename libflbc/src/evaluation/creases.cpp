// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <string>
#include <tuple>
#include <vector>

#include <Eigen/Geometry>

#include "base/shape_checks.h"
#include "flbc/check.h"
#include "flbc/errors.h"

namespace flbc {
namespace {

// A directed edge of a triangle, by its ends in ascending order.
struct Edge {
  Index low, high;
  Index triangle;

  bool joins(const Edge& other) const { return low == other.low && high == other.high; }
};

std::vector<Edge> sorted_edges(const FacetList<3>& triangles) {
  std::vector<Edge> edges;
  for (Index t = 0; t < static_cast<Index>(triangles.cols()); ++t) {
    for (int k = 0; k < 3; ++k) {
      const auto [low, high] = std::minmax({triangles(k, t), triangles((k + 1) % 3, t)});
      if (low != high) edges.push_back({low, high, t});
    }
  }
  std::sort(edges.begin(), edges.end(), [](const Edge& a, const Edge& b) {
    return std::tie(a.low, a.high, a.triangle) < std::tie(b.low, b.high, b.triangle);
  });
  return edges;
}

Vector<3> normal(const PointList<3>& points, const FacetList<3>& triangles, Index triangle) {
  const Vector<3> corner = points.col(triangles(0, triangle));
  const Vector<3> first = points.col(triangles(1, triangle)) - corner;
  const Vector<3> second = points.col(triangles(2, triangle)) - corner;
  return first.cross(second);
}

// The angle between the faces at an edge, in degrees, signed: positive where they form a ridge. NaN
// if a face is degenerate.
double angle_at(const PointList<3>& points, const FacetList<3>& triangles, const Edge& one,
                const Edge& other) {
  const Vector<3> a = normal(points, triangles, one.triangle);
  const Vector<3> b = normal(points, triangles, other.triangle);
  if (!(a.norm() > 0) || !(b.norm() > 0)) return std::nan("");
  const Vector<3> axis = points.col(one.high) - points.col(one.low);
  constexpr double kDegree = 180 / 3.14159265358979323846;
  return kDegree * std::atan2(a.cross(b).dot(axis.normalized()), a.dot(b));
}

}  // namespace

CreaseCheck check_creases(const PointList<3>& rest, const PointList<3>& posed,
                          const FacetList<3>& triangles) {
  if (rest.cols() != posed.cols()) {
    throw InputError("a pose with " + std::to_string(posed.cols()) +
                     " points does not match a surface with " + std::to_string(rest.cols()));
  }
  check_indices(triangles, rest.cols(), {"surface", "triangle", "vertex", "vertices"});
  const auto edges = sorted_edges(triangles);
  CreaseCheck check;
  std::vector<double> changes;
  for (std::size_t k = 0; k + 1 < edges.size(); ++k) {
    const Edge& one = edges[k];
    const bool has_two_faces = one.joins(edges[k + 1]) && (k == 0 || !one.joins(edges[k - 1])) &&
                               (k + 2 == edges.size() || !one.joins(edges[k + 2]));
    if (!has_two_faces) continue;
    double change = std::abs(angle_at(posed, triangles, one, edges[k + 1]) -
                             angle_at(rest, triangles, one, edges[k + 1]));
    if (!std::isfinite(change)) continue;
    change = std::min(change, 360 - change);
    changes.push_back(change);
    if (change <= check.largest) continue;
    check.largest = change;
    check.ends[0] = one.low;
    check.ends[1] = one.high;
  }
  if (changes.empty()) return check;
  check.edges = static_cast<Index>(changes.size());
  for (const double change : changes) check.mean += change / static_cast<double>(check.edges);
  const auto rank = changes.begin() + static_cast<std::ptrdiff_t>(changes.size() - 1) * 99 / 100;
  std::nth_element(changes.begin(), rank, changes.end());
  check.high = *rank;
  return check;
}

}  // namespace flbc
