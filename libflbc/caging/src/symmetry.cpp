// SPDX-License-Identifier: BSD-3-Clause
#include "caging/symmetry.h"

#include <algorithm>

#include "caging/enclosure.h"

namespace flbc {

namespace {

// Largest distance of a mirror image from the model, relative to the model's size.
constexpr double kTolerance = 0.005;

template <int Dim>
MirrorPlane plane_across(const Enclosure<Dim>& model, int axis) {
  return {axis, model.box().center()(axis)};
}

// The largest distance of mirrored vertices from the model.
template <int Dim>
double asymmetry(const Enclosure<Dim>& model, const PointList<Dim>& points,
                 const MirrorPlane& plane, double limit) {
  constexpr Index kMostVertices = 4000;
  const Index step = std::max<Index>(1, static_cast<Index>(points.cols()) / kMostVertices);
  double largest = 0;
  for (Index v = 0; v < points.cols() && largest < limit; v += step) {
    const Vector<Dim> image = plane.mirrored(Vector<Dim>(points.col(v)));
    largest = std::max(largest, model.distance(image, limit));
  }
  return largest;
}

}  // namespace

template <int Dim>
MirrorPlane find_symmetry(const PointList<Dim>& points, const FacetList<Dim>& facets,
                          CageSymmetry wanted) {
  if (wanted == CageSymmetry::kNone) return {};
  const Enclosure<Dim> model(points, facets);
  if (wanted == CageSymmetry::kX) return plane_across(model, 0);
  if (wanted == CageSymmetry::kY) return plane_across(model, 1);
  if (Dim == 3 && wanted == CageSymmetry::kZ) return plane_across(model, Dim - 1);
  MirrorPlane best;
  double least = kTolerance * model.box().diagonal().norm();
  for (int axis = 0; axis < Dim; ++axis) {
    const auto plane = plane_across(model, axis);
    const double own = asymmetry(model, points, plane, least);
    if (own < least) {
      least = own;
      best = plane;
    }
  }
  return best;
}

template MirrorPlane find_symmetry(const PointList<2>&, const FacetList<2>&, CageSymmetry);
template MirrorPlane find_symmetry(const PointList<3>&, const FacetList<3>&, CageSymmetry);

}  // namespace flbc
