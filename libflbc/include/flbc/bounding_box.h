// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! The size of a set of points, to which all tolerances are relative.
#pragma once

#include "flbc/types.h"

namespace flbc {

//! Diagonal of the axis-parallel bounding box.
//! \param points  Dim x P, finite
//! \return a length in the units of the points, 0 if there are none
template <int Dim>
double bounding_box_diagonal(const PointList<Dim>& points);

//! Points outside a cage, its mesh or the hull of its control points by at most this fraction of
//! the size (bounding_box_diagonal) count as boundary points, because files have few digits.
constexpr double kBoundaryTolerance = 1e-6;

}  // namespace flbc
