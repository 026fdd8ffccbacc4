// SPDX-License-Identifier: BSD-3-Clause
// A domain mesh that follows control points.
#pragma once

#include "flbc/domain_mesh.h"
#include "flbc/sparse_weights.h"

namespace flbc {

//! \param weights  of the vertices of the mesh \param control_points  Dim x n
//! \throws InputError naming the first cell that would be inverted or degenerate
template <int Dim>
DomainMesh<Dim> moved_mesh(const DomainMesh<Dim>& mesh, const SparseWeights& weights,
                           const PointList<Dim>& control_points);

}  // namespace flbc
