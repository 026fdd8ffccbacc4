// SPDX-License-Identifier: BSD-3-Clause
// Weights from the nearest place on another version of a model.
#pragma once

#include "flbc/domain_mesh.h"
#include "flbc/sparse_weights.h"

namespace flbc {

//! Weights at other points, interpolated linearly at the nearest place on a model.
//! \param from  model with weights \param weights  of its P points \param to  Dim x Q
//! \param limit  maximum distance of a point from the model, in its units
//! \param distances  output: Q distances from the model; may be null
//! \return weights of Q points
//! \throws InputError if sizes do not match, or points are farther away than the limit, naming
//! their number, the first, and the farthest
template <int Dim>
SparseWeights nearest_weights(const ModelElements<Dim>& from, const SparseWeights& weights,
                              const PointList<Dim>& to, double limit,
                              Eigen::VectorXd* distances = nullptr);

}  // namespace flbc
