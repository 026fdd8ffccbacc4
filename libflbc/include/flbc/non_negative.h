// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Makes weights non-negative and keeps sum and reproduction.
#pragma once

#include <optional>
#include <vector>

#include "flbc/sparse_weights.h"

namespace flbc {

//! Replaces every column by the nearest one (in the Euclidean norm) with w >= 0, sum w = 1 and
//! sum w c = x. Afterwards no weight is below 0 (nor -0), and sum and reproduction hold to 1e-13,
//! the latter relative to the size of the control points. Feasible columns are
//! unchanged. A point outside the convex hull of the control points by at most kBoundaryTolerance
//! of their size counts as the nearest point of the hull. Where rounding hides the nearest weights
//! (points on the boundary of the hull where control points are within 1e-8 of the size from a
//! facet) the weights may be other feasible ones. The projection is computed in its dual by a
//! semismooth Newton method (Qi and Sun 1993).
//! \param control_points  Dim x n, n >= 1, finite
//! \param points  Dim x P, finite, in the units of the control points
//! \param weights  n x P, finite; replaced
//! \param columns  the points to project, each at most once; all of them if not given. Columns of
//! other points are neither read nor written.
//! \throws InputError if sizes do not fit, if a number is not finite, if a column is out of range,
//! or if a point lies outside the convex hull, naming the first such point; the weights of other
//! points may be projected then
template <int Dim>
void project_non_negative(const PointList<Dim>& control_points, const PointList<Dim>& points,
                          WeightMatrix& weights,
                          const std::optional<std::vector<Index>>& columns = {});

//! The same for weights without their zeros. \return weights of all points
template <int Dim>
SparseWeights project_non_negative(const PointList<Dim>& control_points,
                                   const PointList<Dim>& points, const SparseWeights& weights,
                                   const std::optional<std::vector<Index>>& columns = {});

}  // namespace flbc
