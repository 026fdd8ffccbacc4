// SPDX-License-Identifier: BSD-3-Clause
#include "cage/facet_locator.h"

#include "base/shape_checks.h"
#include "linear/dense.h"

namespace flbc {
namespace {

constexpr double kRounding = 1e-12;  // a smaller coordinate counts as zero

}  // namespace

template <int Dim>
FacetLocator<Dim>::FacetLocator(const Cage<Dim>& cage, double tolerance)
    : facets_(cage.facets.cols()), tolerance_(tolerance) {
  check_elements(cage.points, cage.facets, kCageNames);
  for (std::size_t f = 0; f < facets_.size(); ++f) {
    auto& facet = facets_[f];
    facet.origin = cage.points.col(cage.facets(0, f));
    for (int k = 0; k < Dim; ++k) {
      facet.corners.col(k) = cage.points.col(cage.facets(k, f)) - facet.origin;
    }
    facet.low = facet.origin + facet.corners.rowwise().minCoeff();
    facet.low.array() -= tolerance;
    facet.high = facet.origin + facet.corners.rowwise().maxCoeff();
    facet.high.array() += tolerance;
    const Eigen::Matrix<double, Dim, Dim - 1> edges = facet.corners.template rightCols<Dim - 1>();
    facet.to_coordinates = dense::least_squares(edges, Eigen::MatrixXd::Identity(Dim, Dim));
  }
}

template <int Dim>
FacetPlace<Dim> FacetLocator<Dim>::locate(const Vector<Dim>& point) const {
  const auto place = nearest(point);
  return place.distance <= tolerance_ ? place : FacetPlace<Dim>{};
}

template <int Dim>
FacetPlace<Dim> FacetLocator<Dim>::nearest(const Vector<Dim>& point) const {
  FacetPlace<Dim> nearest;
  for (std::size_t f = 0; f < facets_.size(); ++f) {
    const auto& facet = facets_[f];
    if ((point.array() < facet.low.array()).any() || (point.array() > facet.high.array()).any()) {
      continue;
    }
    const Vector<Dim> offset = point - facet.origin;
    // One refinement step, because the pseudo-inverse alone is too inaccurate on needles.
    Vector<Dim> coordinates = Vector<Dim>::Unit(0);
    for (int step = 0; step < 2; ++step) {
      coordinates.template tail<Dim - 1>() +=
          facet.to_coordinates * (offset - facet.corners * coordinates);
      coordinates[0] = 1 - coordinates.template tail<Dim - 1>().sum();
    }
    // Negative coordinates and rounding errors are clamped, so a point on an edge or at a corner
    // has exact zeros elsewhere.
    coordinates = (coordinates.array() < kRounding).select(0, coordinates);
    coordinates /= coordinates.sum();
    const double distance = (facet.corners * coordinates - offset).norm();
    if (distance < nearest.distance) {
      nearest = {static_cast<Index>(f), coordinates, distance};
    }
  }
  return nearest;
}

template class FacetLocator<2>;
template class FacetLocator<3>;

}  // namespace flbc
