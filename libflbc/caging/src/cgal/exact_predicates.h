// SPDX-License-Identifier: BSD-3-Clause
// Which simplices meet, decided exactly. Implemented by CGAL.
#pragma once

#include "flbc/types.h"

namespace flbc {

//! The control points of a facet.
template <int Dim>
using FacetCorners = Eigen::Matrix<Index, Dim, 1>;

//! The convex hull of one to Dim affinely independent points: a point, a segment, a triangle.
template <int Dim>
struct Simplex {
  Eigen::Matrix<double, Dim, Dim> corners;  //!< a column each, of which the first `count` are used
  int count = Dim;
};

//! The hull of points: corners that coincide are one, and of points on one line only the outermost
//! stay. \param corners  a column per corner, repeated ones allowed
template <int Dim>
Simplex<Dim> simplex_of(const Eigen::Matrix<double, Dim, Dim>& corners);

//! Whether the two have a point in common. \param facet  with Dim corners
template <int Dim>
bool intersect(const Simplex<Dim>& any, const Simplex<Dim>& facet);

//! Whether two facets of a surface have points in common beyond the corners and the edge they
//! share. \param points  Dim x n
template <int Dim>
bool intersect_improperly(const PointList<Dim>& points, const FacetCorners<Dim>& first,
                          const FacetCorners<Dim>& second);

//! How a segment passes a facet.
enum class Passage { kBeside, kThrough, kUnclear };

//! Unclear if the segment begins on the facet, ends in its plane, or runs through its boundary.
template <int Dim>
Passage passage(const Vector<Dim>& from, const Vector<Dim>& to, const Simplex<Dim>& facet);

}  // namespace flbc
