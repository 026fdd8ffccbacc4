// SPDX-License-Identifier: BSD-3-Clause
// Mends what TetGen leaves undone where facets of a cage lie in one plane.
#pragma once

#include "flbc/cage.h"
#include "flbc/domain_mesh.h"

namespace flbc {

//! Two neighbouring facets that include less than this angle (in degrees) short of 180 lie in one
//! plane for TetGen, which then does not keep the edge between them. It is told to be so strict
//! because vertices may lie beside the cage by about as much; with no tolerance at all it fails
//! more often.
constexpr double kCoplanarAngle = 1e-6;

//! Sees to it that every edge of the cage is covered by edges of the mesh, so that each boundary
//! facet of the mesh lies in one facet of the cage: divides boundary edges where they cross edges
//! of the cage. Before that, peels off cells without volume that cling to coplanar facets. Existing
//! vertices keep their numbers and places; new ones follow. \param num_input_points  the vertices
//! before this number do not get lost \throws InputError if there are cells without volume
//! elsewhere
void conform_to_cage(const Cage<3>& cage, Index num_input_points, DomainMesh<3>& mesh);

}  // namespace flbc
