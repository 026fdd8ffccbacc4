// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Common access to dense and sparse weights: the weights of one point, and construction from
//! points.
#pragma once

#include <type_traits>

#include "base/parallel.h"
#include "flbc/sparse_weights.h"

namespace flbc {

inline Eigen::Index num_control_points(const WeightMatrix& weights) {
  return weights.rows();
}
inline Eigen::Index num_control_points(const SparseWeights& weights) {
  return weights.num_control_points();
}

inline Eigen::Index num_points(const WeightMatrix& weights) {
  return weights.cols();
}
inline Eigen::Index num_points(const SparseWeights& weights) {
  return weights.num_points();
}

inline auto column_of(const WeightMatrix& weights, Index point) {
  return weights.col(point);
}
inline Eigen::VectorXd column_of(const SparseWeights& weights, Index point) {
  return weights.at(point);
}

//! Adds the weights of a point times a factor. \param sum  n
inline void add_column(const WeightMatrix& weights, Index point, double factor,
                       Eigen::VectorXd& sum) {
  sum += factor * weights.col(point);
}
inline void add_column(const SparseWeights& weights, Index point, double factor,
                       Eigen::VectorXd& sum) {
  weights.visit(point, [&](Index i, double weight) { sum[i] += factor * weight; });
}

//! \param of_point  returns the n weights of a point; called by several threads
//! \return n x num_points
template <class Weights, class OfPoint>
Weights weights_of_points(Index n, Index num_points, const OfPoint& of_point) {
  if constexpr (std::is_same_v<Weights, SparseWeights>) {
    return SparseWeights::of(n, num_points, of_point);
  } else {
    WeightMatrix weights(n, num_points);
    parallel_for_chunks(num_points, 64, [&](Index p) { weights.col(p) = of_point(p); });
    return weights;
  }
}

}  // namespace flbc
