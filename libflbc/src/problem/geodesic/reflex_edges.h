// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Where shortest ways may bend in 3D.
#pragma once

#include <cstdint>
#include <vector>

#include "flbc/domain_mesh.h"

namespace flbc::distance {

//! For each vertex, whether it lies on an edge of the boundary at which the domain has more than a
//! half space.
std::vector<std::uint8_t> on_reflex_edges(const DomainMesh<3>& mesh,
                                          const MeshTopology<3>& topology);

}  // namespace flbc::distance
