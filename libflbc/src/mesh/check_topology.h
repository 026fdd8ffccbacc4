// SPDX-License-Identifier: BSD-3-Clause
// Checks that a topology belongs to a mesh.
#pragma once

#include "flbc/domain_mesh.h"

namespace flbc {

//! \throws InputError if an index of the mesh is out of range, or the topology is not that of the mesh
template <int Dim>
void check_topology(const DomainMesh<Dim>& mesh, const MeshTopology<Dim>& topology);

}  // namespace flbc
