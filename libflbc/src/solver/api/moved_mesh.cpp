// SPDX-License-Identifier: BSD-3-Clause
#include "solver/api/moved_mesh.h"

#include <cmath>
#include <string>

#include "base/instantiate.h"
#include "base/messages.h"
#include "flbc/bounding_box.h"
#include "flbc/deform.h"
#include "flbc/errors.h"
#include "mesh/cell_geometry.h"

namespace flbc {

template <int Dim>
DomainMesh<Dim> moved_mesh(const DomainMesh<Dim>& mesh, const SparseWeights& weights,
                           const PointList<Dim>& control_points) {
  constexpr double kLeast = 1e-9;  // relative to the measure of the cell before
  DomainMesh<Dim> moved{deform<Dim>(weights, control_points), mesh.cells};
  const double enlargement =
      std::pow(bounding_box_diagonal(moved.points) / bounding_box_diagonal(mesh.points), Dim);
  for (Index s = 0; s < moved.num_cells(); ++s) {
    if (signed_measure(moved, s) > kLeast * enlargement * signed_measure(mesh, s)) continue;
    throw InputError("cell " + std::to_string(s) + " of the domain mesh, at " +
                     format_point(centroid(mesh.points, mesh.cells, s)) +
                     ", would be inverted; move the control points less, or mesh the cage again");
  }
  return moved;
}

FLBC_INSTANTIATE_FUNCTION(moved_mesh)

}  // namespace flbc
