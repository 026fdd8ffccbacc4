// SPDX-License-Identifier: BSD-3-Clause
// The place on the cage nearest to a point that is not inside, and a check of placements.
#pragma once

#include "flbc/cage.h"
#include "flbc/errors.h"
#include "flbc/placement.h"

namespace flbc {

//! \param nearest  as returned by nearest_on_cage()
template <int Dim>
Vector<Dim> place_on_cage(const Cage<Dim>& cage, const NearestOnCage<Dim>& nearest) {
  Vector<Dim> place = Vector<Dim>::Zero();
  for (int k = 0; k < Dim; ++k) {
    place += nearest.coordinates[k] * cage.points.col(cage.facets(k, nearest.facet));
  }
  return place;
}

//! \throws InputError if a placement is not one in this cage
template <int Dim>
void check_placement(const Cage<Dim>& cage, const Placement<Dim>& placement) {
  const auto count = static_cast<Eigen::Index>(placement.places.size());
  bool fits = placement.points.cols() == count;
  for (const auto* points : {&placement.on_cage, &placement.outside}) {
    for (const auto& [point, facet, coordinates, offset] : *points) {
      fits = fits && point >= 0 && point < count && facet >= 0 && facet < cage.facets.cols();
    }
  }
  if (fits) return;
  throw InputError("the placement does not belong to this cage; place_points() makes it");
}

}  // namespace flbc
