// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Distances inside the domain from those on a coarser mesh of it.
#pragma once

#include <vector>

#include "flbc/cell_locator.h"
#include "flbc/distance_weights.h"

namespace flbc {

//! Distances that are known at the vertices of a mesh.
template <int Dim>
struct KnownDistances {
  const DomainMesh<Dim>& mesh;      //!< of the domain
  const PointList<Dim>& sources;    //!< n points, in the units of the mesh
  const DistanceMatrix& distances;  //!< n x V of this mesh, geodesic
};

//! A way is as long as the straight line and a detour round the boundary, of which the detour alone
//! is interpolated: it is zero where the source is in sight, and smooth elsewhere.
//! \param points  Dim x P, in the units of the mesh
//! \param places  of the points in the mesh
//! \return n x P, in the units of the mesh
template <int Dim>
DistanceMatrix interpolated_distances(const KnownDistances<Dim>& known,
                                      const PointList<Dim>& points,
                                      const std::vector<Location<Dim>>& places);

}  // namespace flbc
