// SPDX-License-Identifier: BSD-3-Clause
// Projection onto non-negative weights without a copy of all given weights.
#pragma once

#include <functional>
#include <vector>

#include "flbc/sparse_weights.h"

namespace flbc {

//! project_non_negative() of non_negative.h for weights that are computed point by point.
//! \param columns  points to project
//! \param weights_of  returns the n weights of a point; called by several threads
template <int Dim>
SparseWeights project_columns(const PointList<Dim>& control_points, const PointList<Dim>& points,
                              const std::vector<Index>& columns,
                              const std::function<Eigen::VectorXd(Index)>& weights_of);

}  // namespace flbc
