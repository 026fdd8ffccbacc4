// SPDX-License-Identifier: BSD-3-Clause
// Helper functions for surfaces.
#pragma once

#include <cmath>
#include <vector>

#include <Eigen/Geometry>

#include "flbc/cage.h"
#include "meshing/cgal/exact_predicates.h"

namespace flbc {

//! The facets as a cage of the points they use, in the original order.
template <int Dim>
Cage<Dim> compact(const PointList<Dim>& points, const std::vector<FacetCorners<Dim>>& facets) {
  std::vector<Index> number(static_cast<std::size_t>(points.cols()), -1);
  for (const auto& corners : facets) {
    for (int k = 0; k < Dim; ++k) number[corners(k)] = 0;
  }
  Index size = 0;
  for (Index& n : number) n = n < 0 ? -1 : size++;
  Cage<Dim> cage{PointList<Dim>(Dim, size), FacetList<Dim>(Dim, facets.size())};
  for (Index v = 0; v < points.cols(); ++v) {
    if (number[v] >= 0) cage.points.col(number[v]) = points.col(v);
  }
  for (std::size_t f = 0; f < facets.size(); ++f) {
    for (int k = 0; k < Dim; ++k) cage.facets(k, f) = number[facets[f](k)];
  }
  return cage;
}

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

//! The sum of the normals of the facets at every vertex.
template <int Dim>
PointList<Dim> vertex_normals(const Cage<Dim>& surface) {
  PointList<Dim> normals = PointList<Dim>::Zero(Dim, surface.size());
  for (const auto& facet : surface.facets.colwise()) {
    const Eigen::Matrix<double, Dim, Dim> corners = surface.points(Eigen::all, facet);
    const Vector<Dim> normal = facet_normal<Dim>(corners);
    for (const Index v : facet) normals.col(v) += normal;
  }
  return normals;
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
