// SPDX-License-Identifier: BSD-3-Clause
#include "meshing/cgal/exact_predicates.h"

#include <algorithm>
#include <array>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include "base/instantiate.h"

namespace flbc {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point2 = Kernel::Point_2;
using Point3 = Kernel::Point_3;

Point2 point(const Vector<2>& p) {
  return {p.x(), p.y()};
}
Point3 point(const Vector<3>& p) {
  return {p.x(), p.y(), p.z()};
}

template <int Dim>
auto corner(const Simplex<Dim>& simplex, int k) {
  return point(Vector<Dim>(simplex.corners.col(k)));
}

template <int Dim>
bool on_one_line(const Vector<Dim>& a, const Vector<Dim>& b, const Vector<Dim>& c) {
  return CGAL::collinear(point(a), point(b), point(c));
}

// Of three collinear points, the outer two have the third between them.
Simplex<3> segment_of(const std::array<Vector<3>, 3>& p) {
  for (int middle = 0; middle < 3; ++middle) {
    const auto &a = p[(middle + 1) % 3], &b = p[(middle + 2) % 3];
    if (!CGAL::are_ordered_along_line(point(a), point(p[middle]), point(b))) continue;
    Simplex<3> segment;
    segment.corners << a, b, b;
    segment.count = 2;
    return segment;
  }
  return {};
}

Kernel::Triangle_3 triangle(const Simplex<3>& t) {
  return {corner(t, 0), corner(t, 1), corner(t, 2)};
}

// Moves the corners that `own` shares with `other` to the front.
template <int Dim>
int move_common_first(FacetCorners<Dim>& own, const FacetCorners<Dim>& other) {
  int common = 0;
  for (int k = 0; k < Dim; ++k) {
    if ((other.array() == own(k)).any()) std::swap(own(common++), own(k));
  }
  return common;
}

// For edges with one common end.
bool fold_back(const PointList<2>& points, const FacetCorners<2>& e, const FacetCorners<2>& f) {
  const auto tip = point(Vector<2>(points.col(e(0))));
  const auto a = point(Vector<2>(points.col(e(1)))), b = point(Vector<2>(points.col(f(1))));
  return CGAL::collinear(a, tip, b) && !CGAL::collinear_are_strictly_ordered_along_line(a, tip, b);
}

// For triangles with one common corner: whether the opposite edge of one meets the other.
bool pierce(const PointList<3>& points, const FacetCorners<3>& s, const FacetCorners<3>& t) {
  const auto p = [&](Index vertex) { return point(Vector<3>(points.col(vertex))); };
  const Kernel::Triangle_3 one(p(s(0)), p(s(1)), p(s(2))), other(p(t(0)), p(t(1)), p(t(2)));
  return CGAL::do_intersect(other, Kernel::Segment_3(p(s(1)), p(s(2)))) ||
         CGAL::do_intersect(one, Kernel::Segment_3(p(t(1)), p(t(2))));
}

// For triangles with a common edge: whether they are coplanar and on the same side of it.
bool fold_back(const PointList<3>& points, const FacetCorners<3>& s, const FacetCorners<3>& t) {
  const auto p = [&](Index vertex) { return point(Vector<3>(points.col(vertex))); };
  return CGAL::coplanar(p(s(0)), p(s(1)), p(s(2)), p(t(2))) &&
         CGAL::coplanar_orientation(p(s(0)), p(s(1)), p(s(2)), p(t(2))) != CGAL::NEGATIVE;
}

int side(const Simplex<2>& edge, const Point2& p) {
  return CGAL::orientation(corner(edge, 0), corner(edge, 1), p);
}

int side(const Simplex<3>& t, const Point3& p) {
  return CGAL::orientation(corner(t, 0), corner(t, 1), corner(t, 2), p);
}

// The side on which the line through two points passes facet corners (2D) or edges (3D).
std::array<int, 2> sides_of_line(const Point2& from, const Point2& to, const Simplex<2>& edge) {
  return {CGAL::orientation(from, to, corner(edge, 0)),
          -CGAL::orientation(from, to, corner(edge, 1))};
}

std::array<int, 3> sides_of_line(const Point3& from, const Point3& to, const Simplex<3>& t) {
  std::array<int, 3> sides;
  for (int k = 0; k < 3; ++k) {
    sides[k] = CGAL::orientation(from, to, corner(t, k), corner(t, (k + 1) % 3));
  }
  return sides;
}

}  // namespace

template <int Dim>
Simplex<Dim> simplex_of(const Eigen::Matrix<double, Dim, Dim>& corners) {
  std::array<Vector<Dim>, Dim> distinct;
  int count = 0;
  for (int k = 0; k < Dim; ++k) {
    const Vector<Dim> p = corners.col(k);
    if (std::find(distinct.begin(), distinct.begin() + count, p) == distinct.begin() + count) {
      distinct[count++] = p;
    }
  }
  if constexpr (Dim == 3) {
    if (count == 3 && on_one_line<3>(distinct[0], distinct[1], distinct[2])) {
      return segment_of(distinct);
    }
  }
  Simplex<Dim> simplex;
  simplex.count = count;
  for (int k = 0; k < Dim; ++k) simplex.corners.col(k) = distinct[std::min(k, count - 1)];
  return simplex;
}

template <int Dim>
bool intersect(const Simplex<Dim>& any, const Simplex<Dim>& facet) {
  if constexpr (Dim == 2) {
    const Kernel::Segment_2 edge(corner(facet, 0), corner(facet, 1));
    if (any.count == 1) return edge.has_on(corner(any, 0));
    return CGAL::do_intersect(Kernel::Segment_2(corner(any, 0), corner(any, 1)), edge);
  } else {
    const auto own = triangle(facet);
    if (any.count == 1) return own.has_on(corner(any, 0));
    if (any.count == 2) {
      return CGAL::do_intersect(own, Kernel::Segment_3(corner(any, 0), corner(any, 1)));
    }
    return CGAL::do_intersect(triangle(any), own);
  }
}

template <int Dim>
bool intersect_improperly(const PointList<Dim>& points, const FacetCorners<Dim>& first,
                          const FacetCorners<Dim>& second) {
  FacetCorners<Dim> f = first, g = second;
  const int common = move_common_first<Dim>(f, second);
  move_common_first<Dim>(g, f);
  if (common == Dim) return true;
  if (common == Dim - 1) return fold_back(points, f, g);
  if constexpr (Dim == 3) {
    if (common == 1) return pierce(points, f, g);
  }
  Simplex<Dim> one, other;
  for (int k = 0; k < Dim; ++k) {
    one.corners.col(k) = points.col(f(k));
    other.corners.col(k) = points.col(g(k));
  }
  return intersect(one, other);
}

template <int Dim>
Passage passage(const Vector<Dim>& from, const Vector<Dim>& to, const Simplex<Dim>& facet) {
  const auto p = point(from), q = point(to);
  const int start = side(facet, p), end = side(facet, q);
  if (end == 0) return Passage::kUnclear;
  if (start == 0) {
    Simplex<Dim> beginning;
    beginning.corners = from.replicate(1, Dim);
    beginning.count = 1;
    return intersect(beginning, facet) ? Passage::kUnclear : Passage::kBeside;
  }
  if (start == end) return Passage::kBeside;
  const auto sides = sides_of_line(p, q, facet);
  const auto [low, high] = std::minmax_element(sides.begin(), sides.end());
  if (*low < 0 && *high > 0) return Passage::kBeside;
  return *low == 0 || *high == 0 ? Passage::kUnclear : Passage::kThrough;
}

FLBC_INSTANTIATE_FUNCTION(intersect)
FLBC_INSTANTIATE_FUNCTION(simplex_of)
FLBC_INSTANTIATE_FUNCTION(intersect_improperly)
FLBC_INSTANTIATE_FUNCTION(passage)

}  // namespace flbc
