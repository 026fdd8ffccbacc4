// SPDX-License-Identifier: BSD-3-Clause
// Distances limited to the region where they are needed. If there are many control points, each
// has weights only on a small part of the domain.
#pragma once

#include <vector>

#include "flbc/distance_weights.h"
#include "mesh/vertex_cells.h"

namespace flbc {

//! Distances that are exact up to a separate reach for each source. Beyond the reach they are lower
//! bounds. If the weights that minimize (1) with the resulting phi vanish beyond the reaches, they
//! also minimize (1) with the true phi: the objective is never larger than the true one, and equal
//! for these weights.
struct BoundedDistances {
  DistanceMatrix distances;  //!< n x V; beyond the reach, the larger of reach and straight line
  Eigen::VectorXf reach;     //!< n; infinite if the whole mesh was measured
};

//! geodesic_distances() where needed. Four distant sources are measured everywhere, so the largest
//! distance, to which phi is relative, has an error of about one percent.
//! \param needed  vertices per source, n lists
template <int Dim>
BoundedDistances bounded_distances(const DomainMesh<Dim>& mesh, const MeshTopology<Dim>& topology,
                                   const std::vector<Index>& sources,
                                   const VertexItems<Index>& needed);

}  // namespace flbc
