// SPDX-License-Identifier: BSD-3-Clause
// Interpolates distances from a coarser mesh of the domain.
#pragma once

#include <vector>

#include "flbc/cell_locator.h"
#include "flbc/distance_weights.h"

namespace flbc {

//! Known distances at the vertices of a mesh.
template <int Dim>
struct KnownDistances {
  const DomainMesh<Dim>& mesh;      //!< of the domain
  const PointList<Dim>& sources;    //!< n points, in the units of the mesh
  const DistanceMatrix& distances;  //!< n x V of this mesh, geodesic
};

//! A path length is the straight distance plus a detour around the boundary. Only the detour is
//! interpolated: it is zero where the source is visible, and smooth elsewhere.
//! \param points  Dim x P, in the units of the mesh
//! \param places  of the points in the mesh
//! \return n x P, in the units of the mesh
template <int Dim>
DistanceMatrix interpolated_distances(const KnownDistances<Dim>& known,
                                      const PointList<Dim>& points,
                                      const std::vector<Location<Dim>>& places);

}  // namespace flbc
