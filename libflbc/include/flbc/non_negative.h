// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Makes weights non-negative while preserving partition of unity and reproduction.
#pragma once

#include <optional>
#include <vector>

#include "flbc/masks.h"
#include "flbc/sparse_weights.h"

namespace flbc {

//! Replaces the weights w of every point by the nearest ones (in the Euclidean norm) with w >= 0,
//! sum w = 1 and sum w c = x. Afterwards no weight is negative (nor -0). The sum holds to 1e-13,
//! and reproduction to 1e-13 of the size of the control points. Feasible weights are unchanged. A
//! point without weights keeps none, because it does not move (OutsidePoints::kKeep). A point
//! outside the convex hull of the control points by at most kBoundaryTolerance of their size counts
//! as the nearest point of the hull. The result may be other feasible weights where rounding hides
//! the nearest one. This happens at points on the boundary of the hull, if control points are
//! within 1e-8 of the size from a facet. The projection solves the dual problem with a semismooth
//! Newton method (Qi and Sun 1993).
//! \param control_points  Dim x n, n >= 1, finite
//! \param points  Dim x P, finite, in the units of the control points
//! \param weights  of P points, finite
//! \param some  points to project, each at most once; default: all. The weights of others are
//! returned as given
//! \param masks  of the P points; masked weights become exactly 0
//! \return weights of P points
//! \throws InputError if sizes do not match, a value is not finite, a point is out of range, or it
//! lies outside the convex hull, naming the first such point
template <int Dim>
[[nodiscard]] SparseWeights project_non_negative(const PointList<Dim>& control_points,
                                                 const PointList<Dim>& points,
                                                 const SparseWeights& weights,
                                                 const std::optional<std::vector<Index>>& some = {},
                                                 const PointMasks& masks = {});

}  // namespace flbc
