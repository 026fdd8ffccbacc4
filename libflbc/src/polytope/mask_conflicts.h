// SPDX-License-Identifier: BSD-3-Clause
// Points without weights on the control points that masks allow, and their cure.
#pragma once

#include <vector>

#include "flbc/masks.h"

namespace flbc {

//! Distance from a convex hull, relative to cage size, up to which points are reproduced up to
//! rounding.
constexpr double kReproduced = 2e-14;

//! The masked points outside the convex hull of the control points that may move them, ascending.
//! No weights >= 0 reproduce them.
//! \param control_points  Dim x n \param points  Dim x P
//! \param tolerance  distance from the hull, relative to cage size, of points that are not outside
template <int Dim>
std::vector<Index> mask_conflicts(const PointList<Dim>& control_points,
                                  const PointList<Dim>& points, const PointMasks& masks,
                                  double tolerance = kReproduced);

//! \throws MaskConflict if there are such points, naming their number, the first, and control
//! points without whose masks there are none
//! \param images  control points that are freed together with each; empty: none
template <int Dim>
void refuse_mask_conflicts(const PointList<Dim>& control_points, const PointList<Dim>& points,
                           const PointMasks& masks, const std::vector<Index>& images = {},
                           double tolerance = kReproduced);

}  // namespace flbc
