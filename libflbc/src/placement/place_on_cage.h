// SPDX-License-Identifier: BSD-3-Clause
// The place on the cage nearest to a point that is not inside.
#pragma once

#include "flbc/cage.h"
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

}  // namespace flbc
