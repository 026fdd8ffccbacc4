// SPDX-License-Identifier: BSD-3-Clause
// Triangulates polygons without new vertices.
#pragma once

#include "flbc/cage.h"

namespace flbc {

//! Triangles with their neighbors.
struct PolygonTriangulation {
  CellList<2> triangles;  //!< 3 x T, counterclockwise
  //! 3 x T: row k has the corner of the neighbor opposite to the common edge, which is opposite to
  //! corner k; -1 for edges of the cage.
  CellList<2> opposite;
};

//! The constrained Delaunay triangulation of the interior. Among vertices on a common circle, the
//! first one that is visible is used.
//! \param cage  oriented: the interior is to the left of each edge
//! \throws InputError if there is none, because the cage intersects itself
PolygonTriangulation triangulate_polygon(const Cage<2>& cage);

}  // namespace flbc
