// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Polygons in space as triangles.
#pragma once

#include <vector>

#include "flbc/types.h"

namespace flbc::io {

//! Cuts a polygon along the shorter diagonal if it is convex and has four corners, fanwise if it is
//! convex, else ear by ear. Triangles go round as the polygon does.
//! \param points  in which its vertices are \param polygon  at least 3 vertices
//! \return 3 x (number of corners - 2), vertices
FacetList<3> cut_polygon(const std::vector<Vector<3>>& points, const std::vector<Index>& polygon);

//! The same for a polygon by itself.
//! \param corners  where its corners are, at least 3
//! \return 3 x (number of corners - 2), the numbers of corners
FacetList<3> cut_polygon(const std::vector<Vector<3>>& corners);

}  // namespace flbc::io
