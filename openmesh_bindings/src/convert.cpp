// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/openmesh/convert.h"

#include <algorithm>
#include <utility>

#include "flbc/io/cage_io.h"

namespace flbc::openmesh::internal {

Cage<3> cage_of_polygons(const PointList<3>& points,
                         const std::vector<std::vector<Index>>& polygons) {
  if (polygons.size() == 1) {
    throw InputError(
        "the mesh is a single polygon, not a closed surface; for a 2D cage, "
        "use to_outline()");
  }
  std::vector<Eigen::Matrix<Index, 3, 1>> triangles;
  const std::vector<Vector<3>> places(points.colwise().begin(), points.colwise().end());
  for (const auto& polygon : polygons) {
    const auto parts = io::cut_polygon(places, polygon);
    triangles.insert(triangles.end(), parts.colwise().begin(), parts.colwise().end());
  }
  Cage<3> cage{points, {}};
  cage.facets.resize(3, static_cast<Eigen::Index>(triangles.size()));
  for (std::size_t f = 0; f < triangles.size(); ++f) cage.facets.col(f) = triangles[f];
  return cage;
}

std::vector<Index> loop_of(const Cage<2>& cage) {
  validate(cage);
  // A valid cage has two facets at each control point.
  std::vector<std::pair<Index, Index>> neighbours(cage.size(), {-1, -1});
  const auto add = [&](Index at, Index other) {
    auto& [first, second] = neighbours[at];
    (first < 0 ? first : second) = other;
  };
  for (const auto& facet : cage.facets.colwise()) {
    add(facet[0], facet[1]);
    add(facet[1], facet[0]);
  }
  std::vector<Index> loop{0};
  Index next = std::min(neighbours[0].first, neighbours[0].second);
  while (next != 0) {
    const Index before = loop.back();
    loop.push_back(next);
    const auto& [first, second] = neighbours[next];
    next = first == before ? second : first;
  }
  if (static_cast<Index>(loop.size()) != cage.size()) {
    throw InputError("the cage has several loops and cannot be one polygon: the first has " +
                     std::to_string(loop.size()) + " of the " + std::to_string(cage.size()) +
                     " control points; use triangulate()");
  }
  double twice_area = 0;
  for (std::size_t k = 0; k < loop.size(); ++k) {
    const auto a = cage.points.col(loop[k]);
    const auto b = cage.points.col(loop[(k + 1) % loop.size()]);
    twice_area += a.x() * b.y() - a.y() * b.x();
  }
  if (twice_area < 0) std::reverse(loop.begin() + 1, loop.end());
  return loop;
}

void refuse_face(const char* kind, Index number) {
  throw InputError(std::string(kind) + " " + std::to_string(number) +
                   " does not fit into a half-edge mesh: another one is already on the same side "
                   "of one of its edges, or its neighbors do not form a surface there");
}

}  // namespace flbc::openmesh::internal
