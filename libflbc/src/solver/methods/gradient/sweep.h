// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! The order in which one pass over memory takes a mesh from an iteration's G-step to the duals of
//! the next iteration.
#pragma once

#include <vector>

#include "flbc/domain_mesh.h"
#include "solver/methods/gradient/gradient_kernel.h"

namespace flbc::gradient {

//! The cells and facets of one thread.
struct SweepPart {
  std::vector<Visit> visits;
  std::vector<Closing> closings;  //!< in the order of the visits
  Index num_slots = 0;            //!< the most extrapolated gradients that are needed at a time

  SweepPath path() const { return {visits.data(), visits.size(), closings.data()}; }
};

//! A facet's dual step needs nothing but the extrapolated gradients of its two cells, so it can be
//! made as soon as both are there, while they and its dual are still in the cache. What is needed
//! again later in the sweep only is the extrapolated gradient of cells with neighbours to come; few
//! if the order of cells follows a space-filling curve, so that they stay in the cache, too, and
//! never go to memory. Facets between parts are left for the end.
struct Sweep {
  std::vector<SweepPart> parts;
  std::vector<Index> seams;  //!< facets between parts
};

//! \param num_parts  wanted; fewer for small meshes
template <int Dim>
Sweep make_sweep(const DomainMesh<Dim>& mesh, const MeshTopology<Dim>& topology, int num_parts);

}  // namespace flbc::gradient
