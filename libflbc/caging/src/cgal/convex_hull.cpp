// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <vector>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include "caging/cage_steps.h"
#include "caging/surface_tools.h"

namespace flbc {

namespace {

// Quickhull of Barber, Dobkin, and Huhdanpaa ("The quickhull algorithm for convex hulls", 1996).
// convex_hull_3() of CGAL orders facets by addresses, so that cages would differ between runs.
class Hull {
 public:
  explicit Hull(const PointList<3>& points)
      : points_(points), facet_from_(static_cast<std::size_t>(points.cols())) {}

  Cage<3> surface() {
    if (!add_tetrahedron()) return {};
    for (std::size_t f = 0; f < facets_.size(); ++f) {
      if (!facets_[f].outside.empty()) raise(static_cast<Index>(f));
    }
    std::vector<FacetCorners<3>> alive;
    for (const auto& facet : facets_) {
      if (facet.is_alive) alive.push_back(facet.corners);
    }
    return compact<3>(points_, alive);
  }

 private:
  struct Facet {
    FacetCorners<3> corners;
    std::array<Index, 3> beyond;   // facets at the edges from corner k to k + 1
    std::vector<Index> outside{};  // points; each belongs to one facet
    bool is_alive = true;
  };
  struct Edge {
    Index begin, end, beyond;
  };

  // Positive outside.
  int side(const FacetCorners<3>& corners, Index point) const {
    using Exact = CGAL::Exact_predicates_inexact_constructions_kernel::Point_3;
    const auto at = [&](Index v) { return Exact(points_(0, v), points_(1, v), points_(2, v)); };
    return CGAL::orientation(at(corners(0)), at(corners(1)), at(corners(2)), at(point));
  }

  template <class Height>
  static Index highest(const std::vector<Index>& points, const Height& height) {
    return *std::max_element(points.begin(), points.end(),
                             [&](Index p, Index q) { return height(p) < height(q); });
  }

  // \return false if all points are in a plane
  bool add_tetrahedron() {
    std::vector<Index> all(facet_from_.size());
    std::iota(all.begin(), all.end(), 0);
    const Index a = highest(all, [&](Index p) { return points_(0, p); });
    const auto from_a = [&](Index p) -> Vector<3> { return points_.col(p) - points_.col(a); };
    Index b = highest(all, [&](Index p) { return from_a(p).squaredNorm(); });
    Index c = highest(all, [&](Index p) { return from_a(p).cross(from_a(b)).squaredNorm(); });
    const Vector<3> normal = from_a(b).cross(from_a(c));
    const Index top = highest(all, [&](Index p) { return std::abs(normal.dot(from_a(p))); });
    const int side_of_top = side({a, b, c}, top);
    if (side_of_top == 0) return false;
    if (side_of_top > 0) std::swap(b, c);
    facets_.push_back({{a, b, c}, {}});
    add_fan({{a, c, 0}, {c, b, 0}, {b, a, 0}}, top);
    distribute(all, 0);
    return true;
  }

  // Joins the edges of a loop to a point.
  void add_fan(const std::vector<Edge>& loop, Index apex) {
    const auto first = static_cast<Index>(facets_.size());
    for (const auto& [begin, end, beyond] : loop) {
      const auto number = static_cast<Index>(facets_.size());
      auto& other = facets_[beyond];
      for (int k = 0; k < 3; ++k) {
        if (other.corners(k) == end) other.beyond[k] = number;
      }
      facet_from_[begin] = number;
      facets_.push_back({{begin, end, apex}, {beyond, -1, -1}});
    }
    for (auto f = first; f < static_cast<Index>(facets_.size()); ++f) {
      const Index next = facet_from_[facets_[f].corners(1)];
      facets_[f].beyond[1] = next;
      facets_[next].beyond[2] = f;
    }
  }

  void distribute(const std::vector<Index>& points, std::size_t first) {
    for (const Index p : points) {
      const auto facet = std::find_if(facets_.begin() + first, facets_.end(),
                                      [&](const Facet& f) { return side(f.corners, p) > 0; });
      if (facet != facets_.end()) facet->outside.push_back(p);
    }
  }

  // Replaces the facets that the farthest point outside of a facet sees. They include those in
  // whose planes it is, so that no facet is degenerate.
  void raise(Index number) {
    const Vector<3> normal = facet_normal<3>(points_(Eigen::all, facets_[number].corners));
    const Index apex = highest(facets_[number].outside,
                               [&](Index p) { return normal.dot(Vector<3>(points_.col(p))); });
    std::vector<Index> seen{number}, points;
    std::vector<Edge> border;
    facets_[number].is_alive = false;
    for (std::size_t k = 0; k < seen.size(); ++k) {
      auto& facet = facets_[seen[k]];
      points.insert(points.end(), facet.outside.begin(), facet.outside.end());
      facet.outside.clear();
      for (int edge = 0; edge < 3; ++edge) {
        const Index beyond = facet.beyond[edge];
        auto& other = facets_[beyond];
        if (!other.is_alive) continue;
        if (side(other.corners, apex) < 0) {
          border.push_back({facet.corners(edge), facet.corners((edge + 1) % 3), beyond});
        } else {
          other.is_alive = false;
          seen.push_back(beyond);
        }
      }
    }
    const auto first = facets_.size();
    add_fan(border, apex);
    distribute(points, first);
  }

  const PointList<3>& points_;
  std::vector<Facet> facets_;
  std::vector<Index> facet_from_;  // by the first end of the edge of a loop
};

}  // namespace

Cage<3> convex_hull(const PointList<3>& points) {
  return Hull(points).surface();
}

}  // namespace flbc
