// SPDX-License-Identifier: BSD-3-Clause
// Checks that places belong to a cage and its mesh.
#pragma once

#include <string>

#include "flbc/errors.h"
#include "flbc/placement.h"

namespace flbc {

//! \param num_values  number of vertices with values
//! \throws InputError if the cell of a place does not exist, or one of its vertices has no value
template <int Dim>
void check_place(const DomainMesh<Dim>& mesh, Index num_values, const Location<Dim>& place) {
  if (place.cell >= 0 && place.cell < mesh.num_cells() &&
      mesh.cells.col(place.cell).minCoeff() >= 0 &&
      mesh.cells.col(place.cell).maxCoeff() < num_values) {
    return;
  }
  throw InputError("a place is in cell " + std::to_string(place.cell) +
                   ", which does not exist or has a vertex without values; there are " +
                   std::to_string(mesh.num_cells()) + " cells, and values of " +
                   std::to_string(num_values) + " vertices");
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
