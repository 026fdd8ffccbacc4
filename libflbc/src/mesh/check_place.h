// SPDX-License-Identifier: BSD-3-Clause
// Checks that a place belongs to a mesh.
#pragma once

#include <string>

#include "flbc/cell_locator.h"
#include "flbc/errors.h"

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

}  // namespace flbc
