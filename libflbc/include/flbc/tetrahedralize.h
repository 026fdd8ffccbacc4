// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! From a closed surface to a tetrahedral mesh of its interior. Implemented by the optional
//! component `tetgen`.
#pragma once

#include "flbc/cage.h"
#include "flbc/domain_mesh.h"
#include "flbc/meshing_options.h"

namespace flbc {

//! Quality tetrahedralisation by TetGen, run in a process of its own. Component `tetgen`.
//! Vertices 0 .. n-1 of the mesh are the control points.
//! \param cage  any
//! \param options  number of vertices, points to embed, limit of time
//! \return a valid mesh, in the units of the cage
//! \throws InputError if the cage is defective or TetGen fails on it, OptionError if the options
//! cannot be met
DomainMesh<3> tetrahedralize(const Cage<3>& cage, const MeshingOptions<3>& options = {});

}  // namespace flbc
