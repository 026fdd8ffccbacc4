// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Computes normals of a surface.
#pragma once

#include <vector>

#include "flbc/types.h"

namespace flbc::gltf {

//! The angle-weighted mean of the triangle normals around each vertex, which does not depend on the
//! triangulation of polygons. Copies of a point have the same normal.
//! \param sources  per vertex, the point of which it is a copy \param triangles  3 x T, of vertices
//! \return 3 x number of vertices, of length 1; (0, 0, 1) if all its triangles are degenerate
PointList<3> vertex_normals(const std::vector<Vector<3>>& points, const std::vector<Index>& sources,
                            const FacetList<3>& triangles);

}  // namespace flbc::gltf
