// SPDX-License-Identifier: BSD-3-Clause
// The point of a convex hull nearest to a given one, as a combination of few points.
#pragma once

#include <array>

#include "flbc/types.h"

namespace flbc {

//! A point of the convex hull of some points: sum_k weights[k] * points[support[k]].
template <int Dim>
struct HullPoint {
  int size = 0;                         //!< used entries of the arrays, 1 .. Dim + 1
  std::array<Index, Dim + 1> support;   //!< indices of affinely independent points
  std::array<double, Dim + 1> weights;  //!< > 0, sum 1
  Vector<Dim> point;                    //!< the combination
  double distance;                      //!< from the query point
};

//! Wolfe's algorithm ("Finding the nearest point in a polytope", 1976): it needs no hull facets and
//! handles coincident, collinear, and coplanar points.
//! \param points  Dim x n, n >= 1
template <int Dim>
HullPoint<Dim> nearest_point_in_hull(const PointList<Dim>& points, const Vector<Dim>& query);

}  // namespace flbc
