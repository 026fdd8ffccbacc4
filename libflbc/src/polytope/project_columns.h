// SPDX-License-Identifier: BSD-3-Clause
// Projection onto non-negative weights without a copy of all given weights.
#pragma once

#include <functional>
#include <vector>

#include "flbc/masks.h"
#include "flbc/sparse_weights.h"

namespace flbc {

//! project_non_negative() of non_negative.h for weights that are computed point by point.
//! \param columns  points to project
//! \param weights_of  returns the n weights of a point; called by several threads
//! \param masks  of the points, feasible; masked weights become exactly 0
//! \param negligible  smaller weights become exactly 0 where the others can carry the point
//! with nearly the same weights
template <int Dim>
SparseWeights project_columns(const PointList<Dim>& control_points, const PointList<Dim>& points,
                              const std::vector<Index>& columns,
                              const std::function<Eigen::VectorXd(Index)>& weights_of,
                              const PointMasks& masks = {}, double negligible = 0);

}  // namespace flbc
