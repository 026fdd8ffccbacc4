// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Another way from a closed surface to a tetrahedral mesh of its interior, for cages on which
//! tetrahedralize() fails. Implemented by the optional component `netgen`.
#pragma once

#include "flbc/cage.h"
#include "flbc/domain_mesh.h"
#include "flbc/meshing_options.h"

namespace flbc {

//! Tetrahedralisation by Netgen, run in a process of its own. Component `netgen`; Netgen's library
//! is loaded at run time. Vertices 0 .. n-1 of the mesh are the control points, and its boundary
//! consists of the cage's facets, divided at the middles of edges. Cells in thin walls are flat,
//! where tetrahedralize() would fill them with ever smaller ones. The number of vertices may be off by
//! a third where the facets of the cage are all alike.
//! \param cage  any
//! \param options  number of vertices and limit of time; points cannot be embedded
//! \return a valid mesh, in the units of the cage
//! \throws InputError if the cage is defective or Netgen fails on it, or its library is not there;
//! OptionError if the options cannot be met
DomainMesh<3> tetrahedralize_by_netgen(const Cage<3>& cage, const MeshingOptions<3>& options = {});

}  // namespace flbc
