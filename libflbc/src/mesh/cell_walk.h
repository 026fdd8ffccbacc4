// SPDX-License-Identifier: BSD-3-Clause
// Locates sequences of nearby points in a mesh.
#pragma once

#include <vector>

#include "flbc/cell_locator.h"

namespace flbc {

//! Locates points as locate_points() does, but by walking from cell to cell, starting at the
//! previous point. Walks are short if consecutive points are close. The result does not depend on
//! the number of threads.
//! \param mesh  valid
//! \param topology  of the mesh
//! \param points  Dim x P, in the units of the mesh
//! \return P locations, coordinates >= 0
//! \throws InputError as locate_points()
template <int Dim>
std::vector<Location<Dim>> walk_to_points(const DomainMesh<Dim>& mesh,
                                          const MeshTopology<Dim>& topology,
                                          const PointList<Dim>& points);

}  // namespace flbc
