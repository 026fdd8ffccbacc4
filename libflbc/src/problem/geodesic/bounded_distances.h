// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Distances as far as they are needed: a control point of many has weights on a small part of the
//! domain.
#pragma once

#include <vector>

#include "flbc/distance_weights.h"
#include "mesh/vertex_cells.h"

namespace flbc {

//! Distances that are known up to a reach of their own from each source. Beyond it they are too
//! short rather than too long, so that weights which end within the reaches and minimise (1) with a
//! phi made of them minimise it with the true phi as well: the objective is nowhere larger than the
//! true one, and the same for them.
struct BoundedDistances {
  DistanceMatrix distances;  //!< n x V; beyond the reach, the larger of reach and straight line
  Eigen::VectorXf reach;     //!< n; infinite where all of the mesh was measured
};

//! geodesic_distances() where they are needed. Four sources far from each other are measured
//! everywhere: the largest distance, which phi is relative to, is missed by a percent or so.
//! \param needed  vertices by source, n lists
template <int Dim>
BoundedDistances bounded_distances(const DomainMesh<Dim>& mesh, const MeshTopology<Dim>& topology,
                                   const std::vector<Index>& sources,
                                   const VertexItems<Index>& needed);

}  // namespace flbc
