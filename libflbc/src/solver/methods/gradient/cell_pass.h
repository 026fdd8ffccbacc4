// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! The order of one pass over memory, from the G-step of an iteration to the duals of the next
//! iteration.
#pragma once

#include <vector>

#include "flbc/domain_mesh.h"
#include "solver/methods/gradient/gradient_kernel.h"

namespace flbc::gradient {

//! The cells and facets of one thread.
struct PassPart {
  std::vector<Visit> visits;
  std::vector<Closing> closings;  //!< in the order of the visits
  Index num_slots = 0;            //!< maximum number of extrapolated gradients needed at a time

  PassPath path() const { return {visits.data(), visits.size(), closings.data()}; }
};

//! The dual step of a facet needs only the extrapolated gradients of its two cells. It runs as soon
//! as both are available, while the data are in the cache. The pass keeps the extrapolated
//! gradients of cells with pending neighbors. If cells follow a space-filling curve, there are few
//! of them, and they stay in the cache. Facets between parts are processed at the end.
struct CellPass {
  std::vector<PassPart> parts;
  std::vector<Index> seams;  //!< facets between parts
};

//! \param num_parts  requested number; fewer for small meshes
template <int Dim>
CellPass make_cell_pass(const DomainMesh<Dim>& mesh, const MeshTopology<Dim>& topology,
                        int num_parts);

}  // namespace flbc::gradient
