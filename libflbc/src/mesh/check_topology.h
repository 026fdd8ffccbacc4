// SPDX-License-Identifier: BSD-3-Clause
// Checks that a topology belongs to a mesh.
#pragma once

#include "flbc/domain_mesh.h"

namespace flbc {

//! \param mesh  with indices in range \throws InputError if the topology is not that of the mesh
template <int Dim>
void check_topology(const DomainMesh<Dim>& mesh, const MeshTopology<Dim>& topology);

}  // namespace flbc
