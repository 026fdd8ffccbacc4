// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/io/same_vertices.h"

#include <algorithm>
#include <limits>
#include <map>
#include <numeric>
#include <optional>
#include <set>
#include <utility>

#include "base/union_find.h"
#include "flbc/errors.h"

namespace flbc::io {
namespace {

using Polygon = std::vector<Index>;
using Polygons = std::vector<Polygon>;
using Edge = std::pair<Index, Index>;
using Surface = std::map<Edge, Index>;  // by directed edge, the vertex after it in its polygon

// The polygons, each from its least vertex on, in the direction of the lesser neighbor.
std::multiset<Polygon> normalized(const Polygons& polygons) {
  std::multiset<Polygon> all;
  for (auto polygon : polygons) {
    std::rotate(polygon.begin(), std::min_element(polygon.begin(), polygon.end()), polygon.end());
    if (polygon.size() > 2 && polygon[1] > polygon.back()) {
      std::reverse(polygon.begin() + 1, polygon.end());
    }
    all.insert(std::move(polygon));
  }
  return all;
}

template <class Use>
void for_edges(const Polygons& polygons, const Use& use) {
  for (std::size_t f = 0; f < polygons.size(); ++f) {
    const auto& polygon = polygons[f];
    for (std::size_t k = 0, count = polygon.size(); k < count; ++k) {
      use(static_cast<Index>(f), Edge{polygon[k], polygon[(k + 1) % count]},
          polygon[(k + 2) % count]);
    }
  }
}

Surface surface_of(const Polygons& polygons) {
  Surface next;
  for_edges(polygons, [&](Index, Edge edge, Index vertex) { next.emplace(edge, vertex); });
  return next;
}

// The vertices of the polygons that remain without the edges that the other file does not have;
// nothing if one of them is not a polygon with all vertices on its border.
std::set<std::set<Index>> joined(const Polygons& polygons, const Surface& other) {
  const auto is_kept = [&](Edge edge) {
    return other.count(edge) + other.count({edge.second, edge.first}) > 0;
  };
  UnionFind groups(static_cast<Index>(polygons.size()));
  Surface first;  // polygon by edge
  bool are_simple = true;
  for_edges(polygons, [&](Index f, Edge edge, Index) {
    if (is_kept(edge)) return;
    const auto [at, is_new] = first.emplace(std::minmax(edge.first, edge.second), f);
    are_simple &= is_new || groups.find(at->second) != groups.find(f);
    groups.unite(at->second, f);
  });
  if (!are_simple) return {};
  std::map<Index, std::pair<std::set<Index>, std::size_t>> wholes;  // vertices, edges of the border
  for_edges(polygons, [&](Index f, Edge edge, Index) {
    auto& [vertices, num_edges] = wholes[groups.find(f)];
    vertices.insert(edge.first);
    num_edges += is_kept(edge);
  });
  std::set<std::set<Index>> result;
  for (auto& [_, whole] : wholes) {
    if (whole.first.size() != whole.second) return {};
    result.insert(std::move(whole.first));
  }
  return result;
}

struct Match {
  std::vector<Index> numbers;  // in the pose, by vertex of the rest; -1 if not matched
  std::vector<Index> origins;  // the reverse
  double squares = 0;          // of the distances between the vertices matched last
};

// Matches all polygons that edges connect with an edge of the rest, given the image of the edge.
// \return whether they are the same polygons, no farther away than `bound`
bool extend(Match& match, const PolygonSoup& rest, const Surface& rest_next,
            const PolygonSoup& pose, const Surface& pose_next, Edge start, Edge image,
            double bound) {
  std::set<Edge> done;
  std::vector<std::pair<Edge, Edge>> waiting{{start, image}};
  while (!waiting.empty()) {
    const auto [edge, to] = waiting.back();
    waiting.pop_back();
    Index& number = match.numbers[edge.first];
    Index& origin = match.origins[to.first];
    if (number < 0 && origin < 0) {
      number = to.first;
      origin = edge.first;
      match.squares += (rest.points[edge.first] - pose.points[to.first]).squaredNorm();
    }
    if (number != to.first || origin != edge.first || match.squares > bound) return false;
    if (!done.insert(edge).second) continue;
    const auto next = rest_next.find(edge), next_to = pose_next.find(to);
    if ((next == rest_next.end()) != (next_to == pose_next.end())) return false;
    if (next == rest_next.end()) continue;  // a border
    waiting.push_back({{edge.second, next->second}, {to.second, next_to->second}});
    waiting.push_back({{edge.second, edge.first}, {to.second, to.first}});
  }
  return true;
}

// The number in the pose by vertex of the rest. Whether a file lists the polygons the other way
// around does not matter. \return nothing if a part, which is polygons connected by edges, has no
// match, or if all together would move the vertices by `bound` or more
std::optional<std::vector<Index>> match(const PolygonSoup& rest, const PolygonSoup& pose,
                                        double bound, const std::string& pose_name) {
  constexpr double kEqual = 1 + 1e-9;  // ratio of squares that only rounding separates
  auto turned = pose.polygons;
  for (auto& polygon : turned) std::reverse(polygon.begin(), polygon.end());
  const auto rest_next = surface_of(rest.polygons);
  const Surface images[] = {surface_of(pose.polygons), surface_of(turned)};
  const std::vector<Index> none(rest.points.size(), -1);
  Match found{none, none};
  for (const auto& [edge, _] : rest_next) {
    if (found.numbers[edge.first] >= 0) continue;
    std::optional<Match> best;
    bool is_ambiguous = false;
    for (const auto& pose_next : images) {
      for (const auto& [image, unused] : pose_next) {
        Match part{found.numbers, found.origins};
        const double limit = best ? kEqual * best->squares : bound;
        if (!extend(part, rest, rest_next, pose, pose_next, edge, image, limit)) continue;
        if (best && part.numbers == best->numbers) continue;
        is_ambiguous = best && kEqual * part.squares >= best->squares;
        if (!is_ambiguous) best = std::move(part);
      }
    }
    if (is_ambiguous) {
      throw InputError(pose_name +
                       ": its vertices have other numbers than those of the cage, and " +
                       "several matches move them equally far; keep the numbers of the cage");
    }
    if (!best || best->squares >= bound) return {};
    bound -= best->squares;
    found = std::move(*best);
  }
  // Vertices of no polygon have nothing but their order.
  auto free = found.origins.begin();
  for (Index& number : found.numbers) {
    if (number >= 0) continue;
    free = std::find(free, found.origins.end(), -1);
    number = static_cast<Index>(free++ - found.origins.begin());
  }
  for (auto& polygon : turned = rest.polygons) {
    for (Index& vertex : polygon) vertex = found.numbers[vertex];
  }
  if (normalized(turned) != normalized(pose.polygons)) return {};
  return std::move(found.numbers);
}

// Throws if a polygon of `some` is not one of `all`.
void require_all(const PolygonSoup& some, const std::multiset<Polygon>& all,
                 const std::string& name, const std::string& other) {
  for (std::size_t f = 0; f < some.polygons.size(); ++f) {
    if (all.count(*normalized({some.polygons[f]}).begin()) > 0) continue;
    std::string numbers;
    for (const Index vertex : some.polygons[f]) numbers += ' ' + std::to_string(vertex);
    throw InputError(name + ": face " + std::to_string(f) + " joins vertices" + numbers + ", but " +
                     other + " has no such face, so these are not the same vertices; deform a " +
                     "copy of the cage without adding, removing, or joining vertices");
  }
}

}  // namespace

SameVertices find_same_vertices(const PolygonSoup& rest, const std::string& rest_name,
                                const PolygonSoup& pose, const std::string& pose_name) {
  const auto count = rest.points.size();
  if (pose.points.size() != count) {
    throw InputError(pose_name + ": has " + std::to_string(pose.points.size()) + " vertices, but " +
                     rest_name + " has " + std::to_string(count));
  }
  std::vector<Index> all(count);
  std::iota(all.begin(), all.end(), 0);
  const auto in_rest = normalized(rest.polygons), in_pose = normalized(pose.polygons);
  if (in_pose.empty() || in_rest == in_pose) return {all, false};
  // Small cages have renumberings that divide the same polygons in another way, too: the nearer one
  // is meant.
  const auto joined_rest = joined(rest.polygons, surface_of(pose.polygons));
  const bool are_divided =
      !joined_rest.empty() && joined_rest == joined(pose.polygons, surface_of(rest.polygons));
  double bound = std::numeric_limits<double>::infinity();
  if (are_divided) {
    bound = 0;
    for (std::size_t v = 0; v < count; ++v)
      bound += (rest.points[v] - pose.points[v]).squaredNorm();
  }
  if (auto numbers = match(rest, pose, bound, pose_name)) return {std::move(*numbers), true};
  if (are_divided) return {all, false};
  require_all(pose, in_rest, pose_name, rest_name);
  require_all(rest, in_pose, rest_name, pose_name);
  throw InputError(pose_name + ": has faces twice that " + rest_name + " has once");
}

}  // namespace flbc::io
