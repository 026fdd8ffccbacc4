// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/io/same_vertices.h"

#include <algorithm>
#include <limits>
#include <map>
#include <numeric>
#include <optional>
#include <set>
#include <unordered_map>
#include <utility>

#include "base/union_find.h"
#include "flbc/errors.h"

namespace flbc::io {
namespace {

using Polygon = std::vector<Index>;
using Polygons = std::vector<Polygon>;
using Edge = std::pair<Index, Index>;

// From its least vertex on, in the direction of the lesser neighbor.
Polygon normalized(Polygon polygon) {
  std::rotate(polygon.begin(), std::min_element(polygon.begin(), polygon.end()), polygon.end());
  if (polygon.size() > 2 && polygon[1] > polygon.back()) {
    std::reverse(polygon.begin() + 1, polygon.end());
  }
  return polygon;
}

template <class Use>
void for_edges(const Polygon& polygon, const Use& use) {
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    use(polygon[k], polygon[(k + 1) % polygon.size()]);
  }
}

using PolygonsAtEdges = std::map<Edge, std::vector<Index>>;

PolygonsAtEdges polygons_at_edges(const Polygons& polygons) {
  PolygonsAtEdges at;
  for (std::size_t f = 0; f < polygons.size(); ++f) {
    for_edges(polygons[f],
              [&](Index a, Index b) { at[std::minmax(a, b)].push_back(static_cast<Index>(f)); });
  }
  return at;
}

// The vertices of the polygons that remain without the edges that are not in `kept`, each sorted;
// nothing if one of them is not a polygon with all vertices on its border.
Polygons joined_polygons(const Polygons& polygons, const PolygonsAtEdges& at_edges,
                         const PolygonsAtEdges& kept) {
  UnionFind groups(static_cast<Index>(polygons.size()));
  for (const auto& [edge, sides] : at_edges) {
    if (kept.count(edge) > 0) continue;
    for (const Index f : sides) groups.unite(sides.front(), f);
  }
  struct Joined {
    std::set<Index> vertices;
    std::size_t num_triangles = 0, num_edges = 0;  // edges of the border
  };
  std::map<Index, Joined> joined;
  for (std::size_t f = 0; f < polygons.size(); ++f) {
    auto& whole = joined[groups.find(static_cast<Index>(f))];
    whole.vertices.insert(polygons[f].begin(), polygons[f].end());
    whole.num_triangles += polygons[f].size() - 2;
    for_edges(polygons[f],
              [&](Index a, Index b) { whole.num_edges += kept.count(std::minmax(a, b)); });
  }
  Polygons result;
  for (const auto& [_, whole] : joined) {
    const auto count = whole.vertices.size();
    if (whole.num_triangles + 2 != count || whole.num_edges != count) return {};
    result.emplace_back(whole.vertices.begin(), whole.vertices.end());
  }
  std::sort(result.begin(), result.end());
  return result;
}

// Whether two files divide the same polygons, each in its way.
bool divide_same_polygons(const Polygons& a, const Polygons& b) {
  const auto at_a = polygons_at_edges(a), at_b = polygons_at_edges(b);
  const auto joined = joined_polygons(a, at_a, at_b);
  return !joined.empty() && joined == joined_polygons(b, at_b, at_a);
}

// The corners of all polygons one after the other; corner h begins the half-edge to corner next[h].
struct HalfEdges {
  std::vector<Index> vertex, next, opposite,
      size;  // opposite: -1 at a border; size: of its polygon

  explicit HalfEdges(const Polygons& polygons) {
    std::map<Edge, Index> numbers;
    for (const auto& polygon : polygons) {
      const auto first = static_cast<Index>(vertex.size());
      const auto count = static_cast<Index>(polygon.size());
      for (Index k = 0; k < count; ++k) {
        vertex.push_back(polygon[k]);
        next.push_back(first + (k + 1) % count);
        size.push_back(count);
      }
    }
    opposite.assign(vertex.size(), -1);
    for (Index h = 0; h < Index(vertex.size()); ++h) {
      is_surface &= numbers.emplace(Edge{vertex[h], vertex[next[h]]}, h).second;
    }
    for (const auto& [edge, h] : numbers) {
      const auto other = numbers.find({edge.second, edge.first});
      if (other != numbers.end()) opposite[h] = other->second;
    }
  }

  bool is_surface = true;  // no two polygons pass an edge in the same direction
};

// One part of the rest on one part of the pose.
struct Match {
  std::unordered_map<Index, Index> numbers;  // in the pose, by vertex of the rest
  double squares = 0;                        // of the distances between matched vertices
};

// Matches parts, which are polygons connected by edges. Where a file lists the polygons the other
// way round is no matter.
class Matcher {
 public:
  Matcher(const PolygonSoup& rest, const PolygonSoup& pose)
      : rest_points_(rest.points),
        pose_points_(pose.points),
        rest_(rest.polygons),
        pose_(pose.polygons),
        turned_(turned(pose.polygons)),
        is_taken_(pose.points.size(), false) {}

  // By vertex of the rest, -1 where no polygon is. \return nothing if a part has no match, or if
  // all together would move the vertices by `bound` or more
  std::optional<std::vector<Index>> match(double bound, const std::string& pose_name) {
    if (!rest_.is_surface || !pose_.is_surface) return {};
    std::vector<Index> numbers(rest_points_.size(), -1);
    double squares = 0;
    for (Index h = 0; h < Index(rest_.vertex.size()); ++h) {
      if (numbers[rest_.vertex[h]] >= 0) continue;
      const auto part = match_part(h, bound, pose_name);
      if (!part || (squares += part->squares) >= bound) return {};
      for (const auto& [vertex, number] : part->numbers) {
        numbers[vertex] = number;
        is_taken_[number] = true;
      }
    }
    return numbers;
  }

 private:
  static constexpr double kEqual = 1 + 1e-9;  // ratio of squares that only rounding tells apart

  static Polygons turned(Polygons polygons) {
    for (auto& polygon : polygons) std::reverse(polygon.begin(), polygon.end());
    return polygons;
  }

  double square(Index rest, Index pose) const {
    return (rest_points_[rest] - pose_points_[pose]).squaredNorm();
  }

  std::optional<Match> match_part(Index start, double bound, const std::string& pose_name) const {
    std::vector<std::pair<const HalfEdges*, Index>> candidates;
    for (const auto* pose : {&pose_, &turned_}) {
      for (Index h = 0; h < Index(pose->vertex.size()); ++h) {
        if (!is_taken_[pose->vertex[h]]) candidates.emplace_back(pose, h);
      }
    }
    // Nearest first, because a match is given up when it is worse than the best one.
    std::stable_sort(candidates.begin(), candidates.end(), [&](const auto& a, const auto& b) {
      const Index vertex = rest_.vertex[start];
      return square(vertex, a.first->vertex[a.second]) < square(vertex, b.first->vertex[b.second]);
    });
    std::optional<Match> best;
    bool is_ambiguous = false;
    for (const auto& [pose, h] : candidates) {
      auto match = follow(start, *pose, h, best ? kEqual * best->squares : bound);
      if (!match || (best && match->numbers == best->numbers)) continue;
      is_ambiguous = best && kEqual * match->squares >= best->squares;
      if (!is_ambiguous) best = std::move(match);
    }
    if (is_ambiguous) {
      throw InputError(pose_name +
                       ": its vertices have other numbers than those of the cage, and " +
                       "several matches move them equally far; keep the numbers of the cage");
    }
    return best;
  }

  // From a pair of half-edges over all polygons that are connected with them.
  std::optional<Match> follow(Index start, const HalfEdges& pose, Index image, double bound) const {
    Match match;
    std::unordered_map<Index, Index> vertex_of;  // of the rest, by vertex of the pose
    std::unordered_map<Index, Index> image_of;   // half-edges of the pose by those of the rest
    std::vector<std::pair<Index, Index>> waiting{{start, image}};
    while (!waiting.empty()) {
      auto [a, b] = waiting.back();
      waiting.pop_back();
      if (image_of.count(a) > 0) continue;  // the vertices agree, and they have one edge
      if (rest_.size[a] != pose.size[b]) return {};
      for (Index k = rest_.size[a]; k > 0; --k, a = rest_.next[a], b = pose.next[b]) {
        const Index from = rest_.vertex[a];
        const Index to = pose.vertex[b];
        const auto [here, is_new] = match.numbers.emplace(from, to);
        if (here->second != to || vertex_of.emplace(to, from).first->second != from) return {};
        if (is_new) match.squares += square(from, to);
        if (match.squares > bound) return {};
        image_of.emplace(a, b);
        if ((rest_.opposite[a] < 0) != (pose.opposite[b] < 0)) return {};
        if (rest_.opposite[a] >= 0) waiting.emplace_back(rest_.opposite[a], pose.opposite[b]);
      }
    }
    return match;
  }

  const std::vector<Vector<3>>& rest_points_;
  const std::vector<Vector<3>>& pose_points_;
  HalfEdges rest_, pose_, turned_;
  std::vector<bool> is_taken_;  // vertices of the pose
};

std::string numbers_of(const Polygon& polygon) {
  std::string text;
  for (const Index vertex : polygon) text += ' ' + std::to_string(vertex);
  return text;
}

// Names the first polygon of the pose that the rest does not have, or else the first one of the
// rest that the pose does not have.
[[noreturn]] void fail(const PolygonSoup& rest, const std::string& rest_name,
                       const PolygonSoup& pose, const std::string& pose_name) {
  const auto require_all = [](const Polygons& some, const Polygons& all, const std::string& name,
                              const std::string& other) {
    std::set<Polygon> there;
    for (const auto& polygon : all) there.insert(normalized(polygon));
    for (std::size_t f = 0; f < some.size(); ++f) {
      if (there.count(normalized(some[f])) > 0) continue;
      throw InputError(name + ": face " + std::to_string(f) + " joins vertices" +
                       numbers_of(some[f]) + ", but " + other +
                       " has no such face, so these are not the same vertices; deform a copy of " +
                       "the cage without adding, removing, or joining vertices");
    }
  };
  require_all(pose.polygons, rest.polygons, pose_name, rest_name);
  require_all(rest.polygons, pose.polygons, rest_name, pose_name);
  throw InputError(pose_name + ": has faces twice that " + rest_name + " has once");
}

// The numbers as they are.
std::vector<Index> identity(std::size_t count) {
  std::vector<Index> numbers(count);
  std::iota(numbers.begin(), numbers.end(), 0);
  return numbers;
}

Polygons normalized(Polygons polygons) {
  for (auto& polygon : polygons) polygon = normalized(std::move(polygon));
  std::sort(polygons.begin(), polygons.end());
  return polygons;
}

std::size_t num_corners(const Polygons& polygons) {
  std::size_t sum = 0;
  for (const auto& polygon : polygons) sum += polygon.size();
  return sum;
}

}  // namespace

SameVertices find_same_vertices(const PolygonSoup& rest, const std::string& rest_name,
                                const PolygonSoup& pose, const std::string& pose_name) {
  const auto count = rest.points.size();
  if (pose.points.size() != count) {
    throw InputError(pose_name + ": has " + std::to_string(pose.points.size()) + " vertices, but " +
                     rest_name + " has " + std::to_string(count));
  }
  const auto all = identity(count);
  if (pose.polygons.empty() || normalized(rest.polygons) == normalized(pose.polygons)) {
    return {all, false};
  }
  // Small cages have renumberings that divide the same polygons in another way, too: the nearer one
  // is meant.
  const bool are_divided = divide_same_polygons(rest.polygons, pose.polygons);
  double bound = std::numeric_limits<double>::infinity();
  if (are_divided) {
    bound = 0;
    for (std::size_t v = 0; v < count; ++v)
      bound += (rest.points[v] - pose.points[v]).squaredNorm();
  }
  auto numbers = num_corners(rest.polygons) == num_corners(pose.polygons)
                     ? Matcher(rest, pose).match(bound, pose_name)
                     : std::nullopt;
  if (!numbers && are_divided) return {all, false};
  if (!numbers) fail(rest, rest_name, pose, pose_name);
  // Vertices of no polygon have nothing but their order.
  std::set<Index> left(all.begin(), all.end());
  for (const Index number : *numbers) left.erase(number);
  for (Index& number : *numbers) {
    if (number < 0) number = left.extract(left.begin()).value();
  }
  if (!left.empty()) fail(rest, rest_name, pose, pose_name);
  const bool are_renumbered = *numbers != all;
  return {std::move(*numbers), are_renumbered};
}

}  // namespace flbc::io
