// SPDX-License-Identifier: BSD-3-Clause
// One run of Netgen, whose types stay behind this file.
#pragma once

#include "flbc/cage.h"
#include "flbc/domain_mesh.h"

namespace flbc {

//! Fills a surface with tetrahedra in a process of its own.
//! \param surface     outer shells with their normals outwards, cavities the other way round
//! \param longest     of edges of cells, roughly; in the units of the surface
//! \param seconds     after which it is stopped \param time_limit  that messages name
//! \return a mesh that begins with the surface's points and has all of its triangles
//! \throws InputError if Netgen fails, crashes, takes longer or cannot be loaded
DomainMesh<3> run_netgen(const Cage<3>& surface, double longest, double seconds,
                         double time_limit);

}  // namespace flbc
