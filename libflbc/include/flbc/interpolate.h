// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Weights at any points inside, by linear interpolation.
#pragma once

#include <vector>

#include "flbc/cell_locator.h"
#include "flbc/domain_mesh.h"
#include "flbc/sparse_weights.h"

namespace flbc {

//! Weights at located points, by linear interpolation in the containing cell. Reproduction and
//! partition of unity carry over exactly.
//! \param mesh  the mesh of the weights, V vertices
//! \param weights  n x V
//! \param places  cells and barycentric coordinates, as locate_points() gives them
//! \return n x #places
template <int Dim>
WeightMatrix interpolate(const DomainMesh<Dim>& mesh, const WeightMatrix& weights,
                         const std::vector<Location<Dim>>& places);

//! The same at one place, n numbers.
//! \tparam Weights  WeightMatrix or SparseWeights
template <int Dim, class Weights>
Eigen::VectorXd interpolate(const DomainMesh<Dim>& mesh, const Weights& weights,
                            const Location<Dim>& place);

}  // namespace flbc
