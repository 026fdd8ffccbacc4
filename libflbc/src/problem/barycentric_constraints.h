// SPDX-License-Identifier: BSD-3-Clause
// Partition of unity and reproduction as one linear system per point, and the projection onto it.
#pragma once

#include "flbc/types.h"

namespace flbc {

//! The constraints A^T w = [1; x] with A = [1; c] (n x (Dim + 1)), and for gradients (8): A^T g_d =
//! [0; e_d]. With A = Q R and orthonormal Q, both prescribe Q^T w or Q^T g_d. A projection costs 2
//! n (Dim + 1) multiplications; the n x n matrix K of the paper would cost n^2.
template <int Dim>
class BarycentricConstraints {
 public:
  //! \param control_points  Dim x n, affinely spanning R^Dim
  explicit BarycentricConstraints(const PointList<Dim>& control_points);

  //! n x (Dim + 1), orthonormal columns.
  const Eigen::Matrix<double, Eigen::Dynamic, Dim + 1>& basis() const { return basis_; }

  //! (Dim + 1) x Dim: Q^T g_d for every gradient that satisfies (8), one column per direction d.
  Eigen::Matrix<double, Dim + 1, Dim> gradient_target() const;

  //! Q^T w for every w with sum 1 that reproduces the point.
  Vector<Dim + 1> weight_target(const Vector<Dim>& point) const {
    Vector<Dim + 1> sums;
    sums << 1, point;
    return inverse_r_transposed_ * sums;
  }

  //! The nearest weights with sum 1 that reproduce the point.
  template <class Column>
  void project_weights(const Vector<Dim>& point, Column&& weights) const {
    const Vector<Dim + 1> excess = basis_.transpose() * weights - weight_target(point);
    weights -= basis_ * excess;
  }

 private:
  Eigen::Matrix<double, Eigen::Dynamic, Dim + 1> basis_;
  Eigen::Matrix<double, Dim + 1, Dim + 1> inverse_r_transposed_;
};

}  // namespace flbc
