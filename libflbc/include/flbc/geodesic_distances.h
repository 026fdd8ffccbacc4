// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Distances inside the domain from its control points.
#pragma once

#include <vector>

#include "flbc/domain_mesh.h"

namespace flbc {

//! n x V: column v holds the distances of point v from n sources, in single precision, as they are
//! computed: they take as much memory as anything in a solve.
using DistanceMatrix = Eigen::MatrixXf;

//! Geodesic distances inside the domain, by fast marching (Sethian 1996) over the cells (Kimmel and
//! Sethian 1998), which see the source as a point: exact to single precision where the way is
//! straight, of first order in the size of the cells where it bends round the boundary. Time and
//! memory grow with the mesh as its number of cells.
//! \param mesh  valid, V vertices
//! \param topology  of the mesh
//! \param sources  vertices of the mesh, one per control point
//! \return #sources x V, in the units of the mesh, >= 0
template <int Dim>
DistanceMatrix geodesic_distances(const DomainMesh<Dim>& mesh, const MeshTopology<Dim>& topology,
                                  const std::vector<Index>& sources);

}  // namespace flbc
