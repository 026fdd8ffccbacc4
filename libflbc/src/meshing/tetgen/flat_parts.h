// SPDX-License-Identifier: BSD-3-Clause
// Repairs TetGen meshes at coplanar neighboring facets of a cage.
#pragma once

#include "flbc/cage.h"
#include "flbc/domain_mesh.h"

namespace flbc {

//! Two neighboring facets are coplanar if the angle between their normals is at most this (in
//! degrees). With its own tolerance of 0.1 degrees, TetGen joins facets that are not coplanar, and
//! puts vertices off the cage.
constexpr double kCoplanarAngle = 1e-6;

//! Whether the cage has coplanar neighboring facets.
bool has_coplanar_facets(const Cage<3>& cage);

//! Removes flat cells at coplanar facets. Because of rounding, TetGen inserts them between the
//! surface triangulation, which contains the cage edges, and the cells below, which need not. The
//! exposed faces are divided where they cross cage edges. Control points that belonged only to flat
//! cells are reinserted. Existing vertices keep their indices and positions; new ones follow. A
//! mesh without such cells is unchanged. \param num_input_points  vertices below this index are
//! kept \throws InputError if flat cells exist elsewhere, or some cannot be removed
void peel_flat_cells(const Cage<3>& cage, Index num_input_points, DomainMesh<3>& mesh);

}  // namespace flbc
