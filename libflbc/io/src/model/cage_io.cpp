// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/io/cage_io.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <utility>
#include <vector>

#include "base/messages.h"
#include "flbc/errors.h"
#include "flbc/io/model_file.h"

namespace flbc::io {
namespace {

using Polygon = std::vector<Index>;

using Edges = std::vector<std::pair<Index, Index>>;

Edges edges_of_polylines(const std::vector<Polygon>& polylines) {
  Edges edges;
  for (const auto& polyline : polylines) {
    for (std::size_t k = 0; k + 1 < polyline.size(); ++k) {
      edges.emplace_back(polyline[k], polyline[k + 1]);
    }
  }
  return edges;
}

// The edges of only one polygon, in its direction: the common boundary.
Edges boundary_edges(const std::vector<Polygon>& polygons) {
  std::map<std::pair<Index, Index>, int> uses;  // by the smaller end
  const auto for_edges = [&](const auto& use) {
    for (const auto& polygon : polygons) {
      for (std::size_t k = 0; k < polygon.size(); ++k) {
        use(polygon[k], polygon[(k + 1) % polygon.size()]);
      }
    }
  };
  for_edges([&](Index from, Index to) { ++uses[std::minmax(from, to)]; });
  Edges edges;
  for_edges([&](Index from, Index to) {
    if (uses[std::minmax(from, to)] == 1) edges.emplace_back(from, to);
  });
  return edges;
}

Edges outline_of(const PolygonSoup& soup) {
  if (!soup.polylines.empty()) return edges_of_polylines(soup.polylines);
  if (!soup.polygons.empty()) return boundary_edges(soup.polygons);
  Polygon loop(soup.points.size());
  std::iota(loop.begin(), loop.end(), 0);
  loop.push_back(0);
  return edges_of_polylines({loop});
}

// The outline of points and polygons in a plane without the vertices inside of it.
struct Outline {
  std::vector<Vector<3>> points;
  Edges edges;

  explicit Outline(const PolygonSoup& soup) : points(soup.points), edges(outline_of(soup)) {
    if (!soup.polylines.empty()) return;
    std::vector<bool> is_inside(points.size(), false);
    for (const auto& polygon : soup.polygons) {
      for (const Index vertex : polygon) is_inside[vertex] = true;
    }
    for (const auto& [from, to] : edges) is_inside[from] = is_inside[to] = false;
    std::vector<Index> numbers(points.size());
    points.clear();
    for (std::size_t v = 0; v < numbers.size(); ++v) {
      numbers[v] = static_cast<Index>(points.size());
      if (!is_inside[v]) points.push_back(soup.points[v]);
    }
    for (auto& [from, to] : edges) from = numbers[from], to = numbers[to];
  }
};

// Edges joined end to end.
std::vector<Polygon> loops_of(const Edges& edges) {
  std::multimap<Index, std::size_t> edges_at;
  for (std::size_t e = 0; e < edges.size(); ++e) {
    edges_at.emplace(edges[e].first, e);
    edges_at.emplace(edges[e].second, e);
  }
  std::vector<bool> is_used(edges.size(), false);
  std::vector<Polygon> loops;
  for (std::size_t start = 0; start < edges.size(); ++start) {
    if (is_used[start]) continue;
    Polygon loop;
    Index end = edges[start].first;
    for (auto e = start; !is_used[e];) {
      is_used[e] = true;
      loop.push_back(end);
      end = edges[e].first == end ? edges[e].second : edges[e].first;
      const auto [first, last] = edges_at.equal_range(end);
      for (auto next = first; next != last && is_used[e]; ++next) e = next->second;
    }
    loops.push_back(std::move(loop));
  }
  return loops;
}

bool is_flat(const PolygonSoup& soup) {
  for (const auto& point : soup.points) {
    if (point.z() != soup.points[0].z()) return false;
  }
  return true;
}

// What to do about points that are in a plane, but in another one.
std::string plane_hint(const PolygonSoup& soup) {
  for (int axis = 0; axis < 2; ++axis) {
    const auto is_in_plane = [&](const auto& point) { return point[axis] == soup.points[0][axis]; };
    if (!std::all_of(soup.points.begin(), soup.points.end(), is_in_plane)) continue;
    const std::string name(1, "xy"[axis]);
    return "; all vertices have the same " + name + ": exchange " + name + " and z";
  }
  return {};
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
                       " is not in the plane of vertex 0, so this is 3D; a 2D cage needs a 2D "
                       "model, with the same z everywhere" +
                       plane_hint(soup));
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
  const bool is_surface = !soup.polygons.empty() && (!is_flat(soup) || outline_of(soup).empty());
  if (is_surface && !soup.polylines.empty()) {
    throw InputError(name +
                     ": has both polygons and polylines; a cage is either a surface (3D) or " +
                     "closed polylines (2D)");
  }
  if (is_surface && !plane_hint(soup).empty()) {
    throw InputError(name + ": is flat, but a 2D cage must have the same z everywhere" +
                     plane_hint(soup));
  }
  if (is_surface) {
    return Cage<3>{to_points<3>(soup, name), triangles_of_polygons(soup)};
  }
  const Outline outline(soup);
  Cage<2> cage{to_points<2>({outline.points, {}, {}}, name), {}};
  cage.facets.resize(2, outline.edges.size());
  for (std::size_t e = 0; e < outline.edges.size(); ++e) {
    cage.facets.col(e) << outline.edges[e].first, outline.edges[e].second;
  }
  return cage;
}

template <>
PolygonSoup control_polygons<3>(const PolygonSoup& soup) {
  return {soup.points, soup.polygons, {}};
}

template <>
PolygonSoup control_polygons<2>(const PolygonSoup& soup) {
  const Outline outline(soup);
  return {outline.points, loops_of(outline.edges), {}};
}

template <int Dim>
PolygonSoup cage_polygons(const Cage<Dim>& cage, double height) {
  PolygonSoup soup;
  for (Index i = 0; i < cage.size(); ++i) {
    Vector<3> point = Vector<3>::Constant(height);
    point.template head<Dim>() = cage.points.col(i);
    soup.points.push_back(point);
  }
  for (const auto& facet : cage.facets.colwise()) {
    (Dim == 2 ? soup.polylines : soup.polygons).emplace_back(facet.begin(), facet.end());
  }
  if (Dim == 2) {
    soup.polylines = control_polygons<2>(soup).polygons;
    for (auto& loop : soup.polylines) loop.push_back(loop.front());
  }
  return soup;
}

template <int Dim>
PointList<Dim> read_pose(const std::string& path, const PolygonSoup& rest,
                         const std::string& name) {
  auto pose = read_polygons(path);
  // Mere points have no faces to compare.
  if (!pose.polygons.empty() || !pose.polylines.empty()) pose = control_polygons<Dim>(pose);
  check_same_vertices(rest, name, pose, path);
  return to_points<Dim>(pose, path);
}

template PolygonSoup cage_polygons(const Cage<2>&, double);
template PolygonSoup cage_polygons(const Cage<3>&, double);
template PointList<2> read_pose(const std::string&, const PolygonSoup&, const std::string&);
template PointList<3> read_pose(const std::string&, const PolygonSoup&, const std::string&);
template PointList<2> to_points(const PolygonSoup&, const std::string&);
template PointList<3> to_points(const PolygonSoup&, const std::string&);

}  // namespace flbc::io
