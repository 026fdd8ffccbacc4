// SPDX-License-Identifier: BSD-3-Clause
// Weights of some points, or of all in another order.
#pragma once

#include <vector>

#include "flbc/sparse_weights.h"

namespace flbc {

//! \param weights  of P points \param points  in [0, P), in any order
//! \return weights of these points, in this order
SparseWeights take_points(const SparseWeights& weights, const std::vector<Index>& points);

}  // namespace flbc
