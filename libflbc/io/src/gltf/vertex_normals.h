// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Normals of a surface that has none.
#pragma once

#include <vector>

#include "flbc/types.h"

namespace flbc::gltf {

//! The mean of the normals of the triangles round each vertex, weighted by their angles there, so
//! that it does not depend on how polygons were cut. Copies of a point have one normal.
//! \param sources  per vertex the point it is a copy of \param triangles  3 x T, of vertices
//! \return 3 x number of vertices, of length 1; (0, 0, 1) where no triangle has an area
PointList<3> vertex_normals(const std::vector<Vector<3>>& points, const std::vector<Index>& sources,
                            const FacetList<3>& triangles);

}  // namespace flbc::gltf
