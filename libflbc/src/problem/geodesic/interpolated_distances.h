// SPDX-License-Identifier: BSD-3-Clause
// Interpolates distances from the coarse mesh of a refined mesh.
#pragma once

#include "flbc/distance_weights.h"
#include "flbc/nested_mesh.h"

namespace flbc {

//! A path length is the straight distance plus a detour around the boundary. Only the detour is
//! interpolated: it is zero where the source is visible, and smooth elsewhere.
//! \param sources  Dim x n
//! \param points  Dim x V vertices of the refined mesh, those of the coarse mesh first
//! \param ends  CoarseMesh::ends, of the V vertices
//! \param distances  n x (number of coarse vertices), geodesic
//! \return n x V, in the units of the points
template <int Dim>
DistanceMatrix interpolated_distances(const PointList<Dim>& sources, const PointList<Dim>& points,
                                      const std::vector<std::array<Index, 2>>& ends,
                                      const DistanceMatrix& distances);

}  // namespace flbc
