// SPDX-License-Identifier: BSD-3-Clause
// Level sets of piecewise linear functions.
#pragma once

#include <vector>

#include "front/primitives.h"

namespace flbc::draw {

//! The levels 1/n, 2/n, ..., (n-1)/n. Zero is left out: wide areas have it up to rounding errors.
std::vector<double> isoline_levels(int n);

//! The level sets as separate segments, one per cell and level that meet. Cells on which the
//! function varies by less than 1e-7 have none: within their plateau a level set has no width or
//! place.
//! \param points  2 x V, \param values  V
//! \param levels  ascending
std::vector<Segment> trace_isolines(const PointList<2>& points, const CellList<2>& cells,
                                    const Eigen::VectorXd& values,
                                    const std::vector<double>& levels);

}  // namespace flbc::draw
