// SPDX-License-Identifier: BSD-3-Clause
// Normals and measures of facets.
#pragma once

#include <Eigen/Geometry>

#include "flbc/cage.h"

namespace flbc {

//! Normal of a facet, with length equal to its measure (3D: twice that). It points to the right of
//! an edge, or to the side from which a triangle is counterclockwise.
template <int Dim>
Vector<Dim> facet_normal(const Eigen::Matrix<double, Dim, Dim>& corners) {
  if constexpr (Dim == 2) {
    const Vector<2> along = corners.col(1) - corners.col(0);
    return {along.y(), -along.x()};
  } else {
    return (corners.col(1) - corners.col(0)).cross(corners.col(2) - corners.col(0));
  }
}

inline double area_of(const PointList<3>& points, const FacetList<3>& facets) {
  double sum = 0;
  for (const auto& facet : facets.colwise()) {
    sum += facet_normal<3>(points(Eigen::all, facet)).norm() / 2;
  }
  return sum;
}

//! Area (2D) or volume (3D) between the facets and the origin, positive for outward normals.
template <int Dim>
double signed_measure(const Cage<Dim>& surface, const Vector<Dim>& origin) {
  double sum = 0;
  for (Index f = 0; f < surface.facets.cols(); ++f) {
    Eigen::Matrix<double, Dim, Dim> corners;
    for (int k = 0; k < Dim; ++k)
      corners.col(k) = surface.points.col(surface.facets(k, f)) - origin;
    sum += corners.determinant() / (Dim == 2 ? 2 : 6);
  }
  return sum;
}

}  // namespace flbc
