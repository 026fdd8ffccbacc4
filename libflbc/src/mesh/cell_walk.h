// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Which cells contain points that follow one another closely.
#pragma once

#include <vector>

#include "flbc/cell_locator.h"

namespace flbc {

//! Locates points as locate_points() does, but by walking from cell to cell, each time from where
//! the last point was found: the better the order of the points, the shorter the ways. The cells
//! found do not depend on the number of threads.
//! \param mesh  valid
//! \param topology  of the mesh
//! \param points  Dim x P, in the units of the mesh
//! \return P places, coordinates not below 0
//! \throws InputError as locate_points()
template <int Dim>
std::vector<Location<Dim>> walk_to_points(const DomainMesh<Dim>& mesh,
                                          const MeshTopology<Dim>& topology,
                                          const PointList<Dim>& points);

}  // namespace flbc
