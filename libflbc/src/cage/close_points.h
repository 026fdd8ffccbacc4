// SPDX-License-Identifier: BSD-3-Clause
// Points that coincide up to a tolerance.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "flbc/types.h"

namespace flbc {

//! Heights along a direction that is no axis and no common diagonal: points of grids, boxes, and
//! planes of one coordinate differ in them, so a sweep does not compare all pairs.
template <int Dim>
Eigen::VectorXd sweep_heights(const PointList<Dim>& points);

//! How much heights of points may differ whose distance is at most `tolerance`, with rounding.
double sweep_reach(const Eigen::VectorXd& heights, double tolerance);

//! Pairs (i, j), i < j, of points whose distance is at most `tolerance`. Each point is paired with
//! at most one earlier point, so k coincident points give k - 1 pairs instead of k^2 / 2. \return
//! at most `limit` pairs, ascending by j
template <int Dim>
std::vector<std::array<Index, 2>> find_close_pairs(const PointList<Dim>& points, double tolerance,
                                                   std::size_t limit);

}  // namespace flbc
