// SPDX-License-Identifier: BSD-3-Clause
// Helper functions for surfaces.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <Eigen/Geometry>

#include "cage/facet_geometry.h"
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

//! The corners of a facet, ascending: the same for facets with the same corners.
template <int Dim>
std::array<Index, Dim> sorted(const FacetCorners<Dim>& corners) {
  std::array<Index, Dim> result;
  std::copy(corners.begin(), corners.end(), result.begin());
  std::sort(result.begin(), result.end());
  return result;
}

//! Finds boxes on one side of a facet without exact arithmetic. Few boxes near a cage meet the
//! planes of its facets, but many are within the boxes around the facets.
template <int Dim>
class PlaneOfFacet {
 public:
  using Box = Eigen::AlignedBox<double, Dim>;

  //! \param all  contains the boxes and the facet
  PlaneOfFacet(const Eigen::Matrix<double, Dim, Dim>& corners, const Box& all)
      : origin_(corners.col(0)), normal_(facet_normal<Dim>(corners)) {
    double lengths = 1;  // their product bounds the rounding errors of the normal
    for (int k = 1; k < Dim; ++k) lengths *= (corners.col(k) - origin_).norm();
    const double reach = all.min().cwiseAbs().cwiseMax(all.max().cwiseAbs()).sum();
    margin_ = 1e-13 * lengths * (reach + all.diagonal().norm());
  }

  //! 1 or -1 for a box that is certainly on one side, 1 for that of the normal. 0 for a facet
  //! without a plane.
  int side_of(const Box& box) const {
    const double height = normal_.dot(box.center() - origin_);
    const double extent = normal_.cwiseAbs().dot(box.sizes()) / 2;
    if (!(std::abs(height) > extent + margin_)) return 0;
    return height > 0 ? 1 : -1;
  }

 private:
  Vector<Dim> origin_, normal_;
  double margin_;
};

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

}  // namespace flbc
