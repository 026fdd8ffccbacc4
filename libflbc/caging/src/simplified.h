// SPDX-License-Identifier: BSD-3-Clause
// Large models with fewer facets.
#pragma once

#include "flbc/cage.h"

namespace flbc {

//! Merges vertices within cells of a grid, as Rossignac and Borrel ("Multi-resolution 3D
//! approximations for rendering complex scenes", 1993). Every vertex moves by less than the
//! diagonal of a cell. \param cell  its side, in model units
//! \return facets without repetition. A vertex that loses all its facets remains as a point
template <int Dim>
Cage<Dim> simplified(const PointList<Dim>& points, const FacetList<Dim>& facets, double cell);

}  // namespace flbc
