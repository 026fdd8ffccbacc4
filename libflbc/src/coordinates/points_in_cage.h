// SPDX-License-Identifier: BSD-3-Clause
// Coordinates that are computed point by point, without a domain mesh.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "base/messages.h"
#include "base/parallel.h"
#include "base/shape_checks.h"
#include "cage/facet_locator.h"
#include "cage/point_in_cage.h"
#include "flbc/bounding_box.h"
#include "flbc/cage.h"
#include "flbc/errors.h"

namespace flbc {

constexpr double kOnCage = 1e-12;  // fraction of cage size within which a point is on the cage

//! Weights of points inside a cage or on it. Points on the cage get their barycentric coordinates
//! in the facet. Points outside by at most kBoundaryTolerance count as on the cage.
//! \param points  Dim x P
//! \param of_point  bool(const Vector<Dim>& x, Eigen::Ref<Eigen::VectorXd> weights) for x inside
//! the cage: sets the n weights, zero before, up to a common factor; returns whether there are any.
//! Called by several threads
//! \return n x P, each column sums to 1
//! \throws InputError naming the first point that is not finite, or outside, or without weights
template <int Dim, class OfPoint>
WeightMatrix weights_in_cage(const Cage<Dim>& cage, const PointList<Dim>& points,
                             const OfPoint& of_point) {
  check_finite<Dim>(points);
  const double size = bounding_box_diagonal(cage.points);
  const FacetLocator<Dim> on_cage(cage, kOnCage * size);
  const FacetLocator<Dim> near_cage(cage, kBoundaryTolerance * size);
  const CageLocator<Dim> inside(cage, 0);
  enum class State : char { kDone, kOutside, kFailed };
  const auto num_points = static_cast<Index>(points.cols());
  std::vector<State> states(static_cast<std::size_t>(num_points), State::kDone);
  WeightMatrix weights = WeightMatrix::Zero(cage.size(), num_points);
  parallel_for_chunks(num_points, 64, [&](Index p) {
    const Vector<Dim> x = points.col(p);
    auto place = on_cage.locate(x);
    const bool is_inside = place.facet < 0 && !inside.is_outside(x);
    if (place.facet < 0 && !is_inside) place = near_cage.locate(x);
    if (is_inside) {
      const bool found = of_point(x, weights.col(p));
      weights.col(p) /= weights.col(p).sum();
      if (!found || !weights.col(p).allFinite()) states[p] = State::kFailed;
    } else if (place.facet >= 0) {
      for (int k = 0; k < Dim; ++k) {
        weights(cage.facets(k, place.facet), p) = place.coordinates[k];
      }
    } else {
      states[p] = State::kOutside;
    }
  });
  const auto bad =
      std::find_if(states.begin(), states.end(), [](State state) { return state != State::kDone; });
  if (bad == states.end()) return weights;
  const auto p = bad - states.begin();
  throw InputError("point " + std::to_string(p) + " at " + format_point(points.col(p)) +
                   (*bad == State::kOutside ? " is outside the cage; these coordinates exist only "
                                              "inside, so use mean value or another method there"
                                            : " has no such coordinates in this cage"));
}

}  // namespace flbc
