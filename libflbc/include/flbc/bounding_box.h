// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! The size of a point set. All tolerances are relative to it.
#pragma once

#include "flbc/types.h"

namespace flbc {

//! Diagonal of the axis-aligned bounding box.
//! \param points  Dim x P, finite
//! \return a length in the units of the points, 0 if there are no points
template <int Dim>
double bounding_box_diagonal(const PointList<Dim>& points);

//! Points that lie outside a cage, its mesh, or the convex hull of its control points by at most
//! this fraction of the size (bounding_box_diagonal) count as boundary points. Files store few
//! digits.
constexpr double kBoundaryTolerance = 1e-6;

}  // namespace flbc
