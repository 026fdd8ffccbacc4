// SPDX-License-Identifier: BSD-3-Clause
// Two reductions of influences in less time than both take.
#pragma once

#include "flbc/sparsify.h"

namespace flbc {

//! As sparsify(), with another result.
//! \param one_more  output, n x P: weights with at most one more influence per point than the
//! options allow, accurate to about 1e-8
template <int Dim>
SparseWeights sparsify_twice(const PointList<Dim>& control_points, const PointList<Dim>& points,
                             const SparseWeights& weights, const SparsifyOptions& options,
                             WeightMatrix& one_more);

}  // namespace flbc
