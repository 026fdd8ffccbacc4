// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Weights for other control points: of cages in cages, curved edges, and subdivided cages.
#pragma once

#include "flbc/sparse_weights.h"

namespace flbc {

//! The product of weights and a map, if the n control points themselves follow m others. With
//! weights of the map >= 0 that sum to 1 and reproduce the n control points, the result has the
//! same properties for the P points. reduce_influences() limits the influences, which grow.
//! \param weights  of P points for n control points
//! \param map  weights of the n control points for m others
//! \return weights of P points for m control points
//! \throws InputError if sizes do not match, or naming the first control point whose weights in the
//! map are negative, or sum to 1 with an error above 1e-9
SparseWeights compose(const SparseWeights& weights, const SparseWeights& map);

}  // namespace flbc
