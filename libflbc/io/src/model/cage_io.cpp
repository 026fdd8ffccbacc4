// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/io/cage_io.h"

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

#include "base/messages.h"
#include "flbc/errors.h"
#include "flbc/io/cut_polygon.h"

namespace flbc::io {
namespace {

using Polygon = std::vector<Index>;

FacetList<2> edges_of_polylines(const std::vector<Polygon>& polylines) {
  std::vector<std::pair<Index, Index>> edges;
  for (const auto& polyline : polylines) {
    for (std::size_t k = 0; k + 1 < polyline.size(); ++k) {
      edges.emplace_back(polyline[k], polyline[k + 1]);
    }
  }
  FacetList<2> facets(2, edges.size());
  for (std::size_t e = 0; e < edges.size(); ++e) facets.col(e) << edges[e].first, edges[e].second;
  return facets;
}

// The edges of only one polygon, in its direction: the common boundary.
FacetList<2> boundary_edges(const std::vector<Polygon>& polygons) {
  std::map<std::pair<Index, Index>, int> uses;  // by the smaller end
  const auto for_edges = [&](const auto& use) {
    for (const auto& polygon : polygons) {
      for (std::size_t k = 0; k < polygon.size(); ++k) {
        use(polygon[k], polygon[(k + 1) % polygon.size()]);
      }
    }
  };
  for_edges([&](Index from, Index to) { ++uses[std::minmax(from, to)]; });
  std::vector<Polygon> edges;
  for_edges([&](Index from, Index to) {
    if (uses[std::minmax(from, to)] == 1) edges.push_back({from, to});
  });
  return edges_of_polylines(edges);
}

FacetList<2> closed_loop(const Polygon& loop) {
  Polygon closed = loop;
  closed.push_back(loop.front());
  return edges_of_polylines({closed});
}

bool is_flat(const PolygonSoup& soup) {
  for (const auto& point : soup.points) {
    if (point.z() != soup.points[0].z()) return false;
  }
  return true;
}

FacetList<3> triangles_of_polygons(const PolygonSoup& soup) {
  std::vector<Eigen::Matrix<Index, 3, 1>> triangles;
  for (const auto& polygon : soup.polygons) {
    const auto parts = cut_polygon(soup.points, polygon);
    triangles.insert(triangles.end(), parts.colwise().begin(), parts.colwise().end());
  }
  FacetList<3> facets(3, triangles.size());
  for (std::size_t f = 0; f < triangles.size(); ++f) facets.col(f) = triangles[f];
  return facets;
}

}  // namespace

template <int Dim>
PointList<Dim> to_points(const PolygonSoup& soup, const std::string& name) {
  PointList<Dim> points(Dim, soup.points.size());
  for (std::size_t v = 0; v < soup.points.size(); ++v) {
    if (Dim == 2 && soup.points[v].z() != soup.points[0].z()) {
      throw InputError(name + ": vertex " + std::to_string(v) + " at " +
                       format_point(soup.points[v]) +
                       " is not in the plane of vertex 0; a 2D cage, and a shape in it, must have "
                       "the same z everywhere");
    }
    points.col(v) = soup.points[v].template head<Dim>();
  }
  return points;
}

AnyCage to_cage(const PolygonSoup& soup, const std::string& name) {
  if (soup.points.empty()) throw InputError(name + ": has no vertices");
  if (soup.polygons.empty() && soup.polylines.empty() && !is_flat(soup)) {
    throw InputError(name +
                     ": has no facets and no polylines; a cage is a closed surface (3D) or closed "
                     "polylines (2D)");
  }
  // A flat closed surface has no boundary in its plane; it is a surface without volume.
  FacetList<2> outline(2, 0);
  if (is_flat(soup)) {
    outline =
        soup.polylines.empty() ? boundary_edges(soup.polygons) : edges_of_polylines(soup.polylines);
  }
  const bool is_surface = !soup.polygons.empty() && outline.cols() == 0;
  if (is_surface && !soup.polylines.empty()) {
    throw InputError(name +
                     ": has both polygons and polylines; a cage is either a surface (3D) or " +
                     "closed polylines (2D)");
  }
  if (is_surface) {
    return Cage<3>{to_points<3>(soup, name), triangles_of_polygons(soup)};
  }
  Cage<2> cage{to_points<2>(soup, name), outline};
  if (soup.polylines.empty() && soup.polygons.empty()) {
    Polygon loop(soup.points.size());
    for (std::size_t v = 0; v < loop.size(); ++v) loop[v] = static_cast<Index>(v);
    cage.facets = closed_loop(loop);
  }
  return cage;
}

template PointList<2> to_points(const PolygonSoup&, const std::string&);
template PointList<3> to_points(const PolygonSoup&, const std::string&);

}  // namespace flbc::io
