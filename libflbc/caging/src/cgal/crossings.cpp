// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <type_traits>
#include <utility>
#include <vector>

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_rational.h>
#include <CGAL/Simple_cartesian.h>

#include "base/messages.h"
#include "base/union_find.h"
#include "cage/box_tree.h"
#include "caging/cells.h"
#include "caging/surface_tools.h"
#include "flbc/bounding_box.h"
#include "meshing/cgal/intersection.h"

namespace flbc {

namespace {

// Fractions alone compile in half the time of the kernel that also keeps intervals, which is faster
// only for tens of thousands of facets.
using ExactKernel = CGAL::Simple_cartesian<CGAL::Exact_rational>;
template <int Dim>
using ExactPoint = std::conditional_t<Dim == 2, ExactKernel::Point_2, ExactKernel::Point_3>;
using Triangulation = CGAL::Constrained_Delaunay_triangulation_2<ExactKernel, CGAL::Default,
                                                                 CGAL::Exact_intersections_tag>;

template <int Dim>
ExactPoint<Dim> exact(const PointList<Dim>& points, Index v) {
  if constexpr (Dim == 2) {
    return {points(0, v), points(1, v)};
  } else {
    return {points(0, v), points(1, v), points(2, v)};
  }
}

// Exact points and their numbers.
template <int Dim>
class PointNumbers {
 public:
  explicit PointNumbers(const PointList<Dim>& points) {
    for (; size_ < points.cols(); ++size_) number_.emplace(exact<Dim>(points, size_), size_);
  }

  Index of(const ExactPoint<Dim>& point) {
    const auto [entry, is_new] = number_.emplace(point, size_);
    if (is_new) {
      ++size_;
      added_.push_back(point);
    }
    return entry->second;
  }

  void append_to(PointList<Dim>& points) const {
    auto v = points.cols();
    points.conservativeResize(Dim, size_);
    for (const auto& point : added_) {
      for (int k = 0; k < Dim; ++k) points(k, v) = CGAL::to_double(point[k]);
      ++v;
    }
  }

 private:
  Index size_ = 0;
  std::map<ExactPoint<Dim>, Index> number_;
  std::vector<ExactPoint<Dim>> added_;
};

// Pairs of facets whose boxes are within the distance of each other.
template <int Dim>
std::vector<std::pair<Index, Index>> close_pairs(const CageDraft<Dim>& draft, double distance) {
  std::vector<typename BoxTree<Dim>::Box> boxes(draft.facets.size());
  for (std::size_t f = 0; f < boxes.size(); ++f) {
    for (const Index v : draft.facets[f].corners) boxes[f].extend(Vector<Dim>(draft.points.col(v)));
  }
  return flbc::close_pairs(boxes, distance);
}

template <int Dim>
std::vector<std::pair<Index, Index>> crossing_pairs(const CageDraft<Dim>& draft) {
  std::vector<std::pair<Index, Index>> pairs;
  for (const auto& [f, g] : close_pairs(draft, 0)) {
    if (intersect_improperly<Dim>(draft.points, draft.facets[f].corners, draft.facets[g].corners)) {
      pairs.emplace_back(f, g);
    }
  }
  return pairs;
}

// Replaces facets by their pieces.
template <int Dim>
void replace(CageDraft<Dim>& draft,
             const std::map<Index, std::vector<FacetCorners<Dim>>>& pieces_of) {
  std::vector<typename CageDraft<Dim>::Facet> facets;
  std::set<Index> cut;
  for (std::size_t f = 0; f < draft.facets.size(); ++f) {
    auto facet = draft.facets[f];
    const auto pieces = pieces_of.find(static_cast<Index>(f));
    if (pieces == pieces_of.end()) {
      facets.push_back(facet);
      continue;
    }
    if (pieces->second.size() > 1) cut.insert(facet.number);
    for (const auto& corners : pieces->second) {
      facet.corners = corners;
      facets.push_back(facet);
    }
  }
  cut.erase(-1);
  draft.facets = facets;
  if (cut.empty()) return;
  const bool is_one = cut.size() == 1;
  draft.changes.push_back(std::string(Dim == 2 ? "edge" : "triangle") + (is_one ? " " : "s ") +
                          describe_list({cut.begin(), cut.end()}) +
                          (is_one ? " crosses or touches others and is cut there"
                                  : " cross or touch others and are cut there"));
}

// A triangle's plane without the axis that is closest to its normal.
class Projection {
 public:
  explicit Projection(const ExactKernel::Triangle_3& triangle)
      : origin_(triangle[0]),
        normal_(CGAL::cross_product(triangle[1] - triangle[0], triangle[2] - triangle[0])) {
    for (int k = 1; k < 3; ++k) {
      if (CGAL::abs(normal_[k]) > CGAL::abs(normal_[axis_])) axis_ = k;
    }
  }

  ExactKernel::Point_2 flat(const ExactKernel::Point_3& p) const { return {p[u()], p[v()]}; }
  ExactKernel::Point_3 lifted(const ExactKernel::Point_2& p) const {
    std::array<ExactKernel::FT, 3> x;
    x[u()] = p.x();
    x[v()] = p.y();
    x[axis_] = origin_[axis_] -
               (normal_[u()] * (p.x() - origin_[u()]) + normal_[v()] * (p.y() - origin_[v()])) /
                   normal_[axis_];
    return {x[0], x[1], x[2]};
  }

 private:
  int u() const { return (axis_ + 1) % 3; }
  int v() const { return (axis_ + 2) % 3; }

  ExactKernel::Point_3 origin_;
  ExactKernel::Vector_3 normal_;
  int axis_ = 0;
};

ExactKernel::Triangle_3 exact_triangle(const CageDraft<3>& draft, Index f) {
  const auto& corners = draft.facets[f].corners;
  return {exact<3>(draft.points, corners(0)), exact<3>(draft.points, corners(1)),
          exact<3>(draft.points, corners(2))};
}

Vector<3> normal_of(const CageDraft<3>& draft, Index f) {
  Eigen::Matrix3d corners;
  for (int k = 0; k < 3; ++k) corners.col(k) = draft.points.col(draft.facets[f].corners(k));
  return facet_normal<3>(corners);
}

ExactKernel::Triangle_2 flat(const Projection& projection, const ExactKernel::Triangle_3& t) {
  return {projection.flat(t[0]), projection.flat(t[1]), projection.flat(t[2])};
}

// Whether two triangles are in one plane, within the tolerance, and have an area in common.
bool overlap(const CageDraft<3>& draft, Index f, Index g, double tolerance) {
  if (normal_of(draft, f).squaredNorm() < normal_of(draft, g).squaredNorm()) std::swap(f, g);
  const Vector<3> normal = normal_of(draft, f).normalized();
  const Vector<3> origin = draft.points.col(draft.facets[f].corners(0));
  for (const Index v : draft.facets[g].corners) {
    if (std::abs(normal.dot(draft.points.col(v) - origin)) > tolerance) return false;
  }
  const auto larger = exact_triangle(draft, f);
  const Projection projection(larger);
  const auto common =
      CGAL::intersection(flat(projection, larger), flat(projection, exact_triangle(draft, g)));
  return common && !shape_in<ExactKernel::Point_2>(*common) &&
         !shape_in<ExactKernel::Segment_2>(*common);
}

using LinesOn = std::map<Index, std::vector<ExactKernel::Segment_3>>;

// Cuts triangles at lines on them. Those that overlap are cut together in the plane of the largest
// one, so that they have the same pieces.
void cut_in_planes(CageDraft<3>& draft, UnionFind& overlapping, const LinesOn& lines_on) {
  std::map<Index, std::vector<Index>> groups;
  for (Index f = 0; f < static_cast<Index>(draft.facets.size()); ++f) {
    groups[overlapping.find(f)].push_back(f);
  }
  PointNumbers<3> numbers(draft.points);
  std::map<Index, std::vector<FacetCorners<3>>> pieces_of;
  for (const auto& [first, members] : groups) {
    if (members.size() == 1 && lines_on.count(first) == 0) continue;
    const Index largest = *std::max_element(members.begin(), members.end(), [&](Index f, Index g) {
      return normal_of(draft, f).squaredNorm() < normal_of(draft, g).squaredNorm();
    });
    const Projection projection(exact_triangle(draft, largest));
    Triangulation plane;
    std::vector<ExactKernel::Triangle_2> outlines;
    std::map<ExactKernel::Point_2, Index> corner_at;
    for (const Index f : members) {
      outlines.push_back(flat(projection, exact_triangle(draft, f)));
      for (int k = 0; k < 3; ++k) {
        corner_at.emplace(outlines.back()[k], draft.facets[f].corners(k));
        plane.insert_constraint(outlines.back()[k], outlines.back()[k + 1]);
      }
      const auto lines = lines_on.find(f);
      if (lines == lines_on.end()) continue;
      for (const auto& line : lines->second) {
        const auto from = projection.flat(line.source()), to = projection.flat(line.target());
        if (from == to) {
          plane.insert(from);
        } else {
          plane.insert_constraint(from, to);
        }
      }
    }
    const auto number_at = [&](const ExactKernel::Point_2& p) {
      const auto corner = corner_at.find(p);
      return corner == corner_at.end() ? numbers.of(projection.lifted(p)) : corner->second;
    };
    for (const auto face : plane.finite_face_handles()) {
      const auto middle = CGAL::centroid(face->vertex(0)->point(), face->vertex(1)->point(),
                                         face->vertex(2)->point());
      FacetCorners<3> corners;
      for (int k = 0; k < 3; ++k) corners(k) = number_at(face->vertex(k)->point());
      for (std::size_t m = 0; m < members.size(); ++m) {
        if (!outlines[m].has_on_unbounded_side(middle)) pieces_of[members[m]].push_back(corners);
      }
    }
  }
  replace(draft, pieces_of);
  numbers.append_to(draft.points);
}

}  // namespace

void cut_at_crossings(CageDraft<2>& draft) {
  PointNumbers<2> numbers(draft.points);
  std::map<Index, std::set<ExactKernel::Point_2>> places_on;  // in order along the edge
  const auto segment = [&](Index f) {
    const auto& corners = draft.facets[f].corners;
    return ExactKernel::Segment_2(exact<2>(draft.points, corners(0)),
                                  exact<2>(draft.points, corners(1)));
  };
  for (const auto& [f, g] : crossing_pairs(draft)) {
    const auto common = CGAL::intersection(segment(f), segment(g));
    if (!common) continue;
    std::vector<ExactKernel::Point_2> places;
    if (const auto* point = shape_in<ExactKernel::Point_2>(*common)) places = {*point};
    if (const auto* part = shape_in<ExactKernel::Segment_2>(*common)) {
      places = {part->source(), part->target()};
    }
    places_on[f].insert(places.begin(), places.end());
    places_on[g].insert(places.begin(), places.end());
  }
  std::map<Index, std::vector<FacetCorners<2>>> pieces_of;
  for (auto& [f, places] : places_on) {
    places.insert({segment(f).source(), segment(f).target()});
    for (auto next = std::next(places.begin()); next != places.end(); ++next) {
      pieces_of[f].emplace_back(numbers.of(*std::prev(next)), numbers.of(*next));
    }
  }
  replace(draft, pieces_of);
  numbers.append_to(draft.points);
}

void cut_at_crossings(CageDraft<3>& draft) {
  UnionFind overlapping(static_cast<Index>(draft.facets.size()));
  LinesOn lines_on;
  for (const auto& [f, g] : crossing_pairs(draft)) {
    const auto common = CGAL::intersection(exact_triangle(draft, f), exact_triangle(draft, g));
    if (!common) continue;
    if (const auto* point = shape_in<ExactKernel::Point_3>(*common)) {
      for (const Index h : {f, g}) lines_on[h].emplace_back(*point, *point);
    } else if (const auto* line = shape_in<ExactKernel::Segment_3>(*common)) {
      for (const Index h : {f, g}) lines_on[h].push_back(*line);
    } else {
      overlapping.unite(f, g);
    }
  }
  cut_in_planes(draft, overlapping, lines_on);
}

void cut_where_facets_overlap(CageDraft<2>&) {
}

void cut_where_facets_overlap(CageDraft<3>& draft) {
  const double tolerance = draft.tolerance * bounding_box_diagonal<3>(draft.points);
  UnionFind overlapping(static_cast<Index>(draft.facets.size()));
  for (const auto& [f, g] : close_pairs(draft, tolerance)) {
    if (overlap(draft, f, g, tolerance)) overlapping.unite(f, g);
  }
  cut_in_planes(draft, overlapping, {});
}

}  // namespace flbc
