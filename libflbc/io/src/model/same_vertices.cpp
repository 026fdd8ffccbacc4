// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/io/cage_io.h"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include <Eigen/Geometry>

#include "base/union_find.h"
#include "flbc/errors.h"

namespace flbc::io {
namespace {

using Polygon = std::vector<Index>;
using Polygons = std::vector<Polygon>;
using Corners = std::set<Index>;
using Edge = std::pair<Index, Index>;  // ascending

Vector<3> area_vector(const Polygon& polygon, const std::vector<Vector<3>>& points) {
  Vector<3> area = Vector<3>::Zero();
  for (std::size_t k = 1; k < polygon.size(); ++k) {
    const auto& start = points[polygon[0]];
    area += (points[polygon[k - 1]] - start).cross(points[polygon[k]] - start);
  }
  return area;
}

// From the least vertex on, in the direction of the lesser neighbor.
Polygon normalized(Polygon polygon) {
  std::rotate(polygon.begin(), std::min_element(polygon.begin(), polygon.end()), polygon.end());
  if (polygon.size() > 2 && polygon[1] > polygon.back()) {
    std::reverse(polygon.begin() + 1, polygon.end());
  }
  return polygon;
}

template <class Use>
void for_edges(const Polygons& polygons, const Use& use) {
  for (std::size_t f = 0; f < polygons.size(); ++f) {
    const auto& polygon = polygons[f];
    for (std::size_t k = 0; k < polygon.size(); ++k) {
      use(static_cast<Index>(f), Edge(std::minmax(polygon[k], polygon[(k + 1) % polygon.size()])));
    }
  }
}

// Polygons without the edges between them that the other file does not have.
struct Whole {
  Corners corners{};
  std::size_t num_edges = 0;  // of the border
  Vector<3> area = Vector<3>::Zero();
  double sum_of_areas = 0;

  bool is_flat() const { return area.norm() > 0.8 * sum_of_areas; }  // two triangles: 74 degrees
};

// By corners; nothing if one of them is not a polygon with all vertices on its border.
std::map<Corners, Whole> joined(const PolygonSoup& soup, const Polygons& other) {
  std::set<Edge> kept;
  for_edges(other, [&](Index, Edge edge) { kept.insert(edge); });
  UnionFind groups(static_cast<Index>(soup.polygons.size()));
  std::map<Edge, Index> first;  // polygon by edge
  bool are_simple = true;
  for_edges(soup.polygons, [&](Index f, Edge edge) {
    if (kept.count(edge) > 0) return;
    const auto [at, is_new] = first.emplace(edge, f);
    are_simple &= is_new || groups.find(at->second) != groups.find(f);
    groups.unite(at->second, f);
  });
  if (!are_simple) return {};
  std::map<Index, Whole> wholes;
  for_edges(soup.polygons, [&](Index f, Edge edge) {
    auto& whole = wholes[groups.find(f)];
    whole.corners.insert({edge.first, edge.second});
    whole.num_edges += kept.count(edge);
  });
  for (std::size_t f = 0; f < soup.polygons.size(); ++f) {
    const auto area = area_vector(soup.polygons[f], soup.points);
    auto& whole = wholes[groups.find(static_cast<Index>(f))];
    whole.area += area;
    whole.sum_of_areas += area.norm();
  }
  std::map<Corners, Whole> result;
  for (auto& [_, whole] : wholes) {
    if (whole.corners.size() != whole.num_edges) return {};
    result.emplace(whole.corners, whole);
  }
  return result;
}

// Whether the files divide the same polygons. Other vertices can join to the same polygons as well,
// in particular of few vertices: one of the files must have these, or they are flat at rest.
bool are_divided(const PolygonSoup& rest, const PolygonSoup& pose) {
  std::set<Corners> given;
  for (const auto* soup : {&rest, &pose}) {
    for (const auto& polygon : soup->polygons) given.emplace(polygon.begin(), polygon.end());
  }
  const auto in_rest = joined(rest, pose.polygons), in_pose = joined(pose, rest.polygons);
  return !in_rest.empty() && in_rest.size() == in_pose.size() &&
         std::all_of(in_rest.begin(), in_rest.end(), [&](const auto& found) {
           const auto& [corners, whole] = found;
           return in_pose.count(corners) > 0 && (given.count(corners) > 0 || whole.is_flat());
         });
}

// Throws if a polygon of `some` is not one of `all`.
void require_all(const Polygons& some, const Polygons& all, const std::string& name,
                 const std::string& other) {
  std::set<Polygon> present;
  for (const auto& polygon : all) present.insert(normalized(polygon));
  for (std::size_t f = 0; f < some.size(); ++f) {
    if (present.count(normalized(some[f])) > 0) continue;
    std::string numbers;
    for (const Index vertex : some[f]) numbers += ' ' + std::to_string(vertex);
    throw InputError(name + ": face " + std::to_string(f) + " joins vertices" + numbers + ", but " +
                     other + " has no such face, so these are not the same vertices in the same " +
                     "order; deform a copy of the cage, and export it with its order of vertices");
  }
}

}  // namespace

void check_same_vertices(const PolygonSoup& rest, const std::string& rest_name,
                         const PolygonSoup& pose, const std::string& pose_name) {
  const auto count = rest.points.size();
  if (pose.points.size() != count) {
    throw InputError(pose_name + ": has " + std::to_string(pose.points.size()) + " vertices, but " +
                     rest_name + " has " + std::to_string(count));
  }
  if (pose.polygons.empty() || are_divided(rest, pose)) return;
  require_all(pose.polygons, rest.polygons, pose_name, rest_name);
  require_all(rest.polygons, pose.polygons, rest_name, pose_name);
}

}  // namespace flbc::io
