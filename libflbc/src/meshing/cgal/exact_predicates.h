// SPDX-License-Identifier: BSD-3-Clause
// Exact intersection tests of simplices, implemented with CGAL.
#pragma once

#include "flbc/types.h"

namespace flbc {

//! The control points of a facet.
template <int Dim>
using FacetCorners = Eigen::Matrix<Index, Dim, 1>;

//! The convex hull of one to Dim affinely independent points: a point, a segment, a triangle.
template <int Dim>
struct Simplex {
  Eigen::Matrix<double, Dim, Dim> corners;  //!< one per column; the first `count` are used
  int count = Dim;
};

//! The hull of points. Merges coincident corners, and keeps only the outermost of collinear points.
//! \param corners  one corner per column; may repeat
template <int Dim>
Simplex<Dim> simplex_of(const Eigen::Matrix<double, Dim, Dim>& corners);

//! Whether the two intersect. \param facet  with Dim corners
template <int Dim>
bool intersect(const Simplex<Dim>& any, const Simplex<Dim>& facet);

//! Whether two facets of a surface intersect outside their common corners and edge. \param points
//! Dim x n
template <int Dim>
bool intersect_improperly(const PointList<Dim>& points, const FacetCorners<Dim>& first,
                          const FacetCorners<Dim>& second);

//! How a segment passes a facet.
enum class Passage { kBeside, kThrough, kUnclear };

//! Unclear if the segment begins on the facet, ends in its plane, or runs through its boundary.
template <int Dim>
Passage passage(const Vector<Dim>& from, const Vector<Dim>& to, const Simplex<Dim>& facet);

}  // namespace flbc
