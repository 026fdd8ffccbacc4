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
//! \param weights  n x V
//! \param places  as returned by locate_points()
//! \return n x number of `places`
template <int Dim>
WeightMatrix interpolate(const DomainMesh<Dim>& mesh, const WeightMatrix& weights,
                         const std::vector<Location<Dim>>& places);

//! The same at one location: n weights.
//! \tparam Weights  WeightMatrix or SparseWeights
template <int Dim, class Weights>
Eigen::VectorXd interpolate(const DomainMesh<Dim>& mesh, const Weights& weights,
                            const Location<Dim>& place);

}  // namespace flbc
