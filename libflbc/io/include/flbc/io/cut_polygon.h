// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Triangulates polygons in space.
#pragma once

#include <vector>

#include "flbc/types.h"

namespace flbc::io {

//! Triangulates a polygon. A convex quadrilateral is cut along its shorter diagonal, another convex
//! polygon into a fan, and any other by ear clipping. Triangles keep the orientation of the
//! polygon. The cut depends on the places and numbers of the vertices, but neither on which corner
//! comes first nor on the orientation. Of two equal diagonals, the one at the lowest number is
//! taken.
//! \param points  coordinates of all vertices \param polygon  at least 3 vertices
//! \return 3 x (number of corners - 2), vertex indices
FacetList<3> cut_polygon(const std::vector<Vector<3>>& points, const std::vector<Index>& polygon);

//! The same for a polygon given by coordinates.
//! \param corners  coordinates of its corners, at least 3
//! \return 3 x (number of corners - 2), corner indices
FacetList<3> cut_polygon(const std::vector<Vector<3>>& corners);

}  // namespace flbc::io
