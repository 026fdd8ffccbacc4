// SPDX-License-Identifier: BSD-3-Clause
// Mends what TetGen leaves where neighbouring facets of a cage lie in one plane.
#pragma once

#include "flbc/cage.h"
#include "flbc/domain_mesh.h"

namespace flbc {

//! Two neighbouring facets whose normals include at most this angle (in degrees) lie in one plane.
//! With TetGen's own tolerance, 0.1 degrees, it joins facets that do not, and puts vertices beside
//! the cage.
constexpr double kCoplanarAngle = 1e-6;

//! True if some neighbouring facets lie in one plane.
bool has_coplanar_facets(const Cage<3>& cage);

//! Peels off cells without volume that cling to coplanar facets: rounding makes TetGen stack them
//! between the surface triangulation, which has the cage's edges, and the cells below, which need
//! not. The faces laid bare are divided where they cross edges of the cage, and control points that
//! belonged to flat cells only are put back. Existing vertices keep their numbers and places; new
//! ones follow. Does nothing to a mesh without such cells. \param num_input_points  the vertices
//! before this number do not get lost \throws InputError if there are cells without volume
//! elsewhere, or some are left
void peel_flat_cells(const Cage<3>& cage, Index num_input_points, DomainMesh<3>& mesh);

}  // namespace flbc
