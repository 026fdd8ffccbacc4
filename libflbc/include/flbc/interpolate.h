// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Weights at any point inside the cage, by linear interpolation.
#pragma once

#include <vector>

#include "flbc/cell_locator.h"
#include "flbc/domain_mesh.h"
#include "flbc/sparse_weights.h"

namespace flbc {

//! Interpolates weights linearly in the cell of each located point. This preserves reproduction and
//! partition of unity exactly.
//! \param mesh  mesh of the weights, V vertices
//! \param weights  of V points
//! \param places  as returned by locate_points()
//! \return weights of the places
template <int Dim>
SparseWeights interpolate(const DomainMesh<Dim>& mesh, const SparseWeights& weights,
                          const std::vector<Location<Dim>>& places);

//! The same at one location: n weights.
template <int Dim>
Eigen::VectorXd interpolate(const DomainMesh<Dim>& mesh, const SparseWeights& weights,
                            const Location<Dim>& place);

}  // namespace flbc
