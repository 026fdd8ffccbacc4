// SPDX-License-Identifier: BSD-3-Clause
// The weights of a point x: the polytope {w >= 0, sum w = 1, sum w c = x}, in units of its control
// points c. All solvers of this module use these units.
#pragma once

#include <algorithm>
#include <limits>
#include <vector>

#include "flbc/bounding_box.h"
#include "flbc/types.h"
#include "polytope/nearest_point_in_hull.h"

namespace flbc {

//! Keeps the multipliers finite for control points in a line or plane.
constexpr double kRidge = 1e-13;

//! The bounding box diagonal of the control points, as a divisor: never 0.
//! \param control_points  Dim x n, n >= 1, finite
template <int Dim>
double scale_of(const PointList<Dim>& control_points) {
  return std::max(bounding_box_diagonal<Dim>(control_points), std::numeric_limits<double>::min());
}

//! (c - x) / scale, Dim x n: the contributions of the weights to the reproduction error.
template <int Dim>
PointList<Dim> scaled_offsets(const PointList<Dim>& control_points, const Vector<Dim>& point,
                              double scale) {
  return (control_points.colwise() - point) / scale;
}

//! A vertex of the polytope of a point of the hull: n weights.
template <int Dim>
Eigen::VectorXd vertex_of(const HullPoint<Dim>& hull_point, Eigen::Index n) {
  Eigen::VectorXd weights = Eigen::VectorXd::Zero(n);
  for (int k = 0; k < hull_point.size; ++k) weights[hull_point.support[k]] = hull_point.weights[k];
  return weights;
}

//! The indices of positive weights, ascending.
template <class Column>
std::vector<Index> positive_entries(const Column& weights) {
  std::vector<Index> entries;
  for (Index i = 0; i < static_cast<Index>(weights.size()); ++i) {
    if (weights[i] > 0) entries.push_back(i);
  }
  return entries;
}

}  // namespace flbc
