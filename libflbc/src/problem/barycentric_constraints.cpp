// SPDX-License-Identifier: BSD-3-Clause
#include "problem/barycentric_constraints.h"

#include <Eigen/LU>

#include "linear/dense.h"

namespace flbc {

template <int Dim>
BarycentricConstraints<Dim>::BarycentricConstraints(const PointList<Dim>& control_points) {
  Eigen::Matrix<double, Eigen::Dynamic, Dim + 1> matrix(control_points.cols(), Dim + 1);
  matrix.col(0).setOnes();
  matrix.template rightCols<Dim>() = control_points.transpose();
  // Gram-Schmidt with reorthogonalization, orthogonal up to rounding.
  basis_ = matrix;
  for (int k = 0; k <= Dim; ++k) {
    for (int pass = 0; pass < 2; ++pass) {
      for (int l = 0; l < k; ++l) basis_.col(k) -= basis_.col(l).dot(basis_.col(k)) * basis_.col(l);
    }
    basis_.col(k).normalize();
  }
  inverse_r_transposed_ = dense::gram<Dim + 1>(basis_, matrix).inverse().transpose();
}

template <int Dim>
Eigen::Matrix<double, Dim + 1, Dim> BarycentricConstraints<Dim>::gradient_target() const {
  return inverse_r_transposed_.template rightCols<Dim>();
}

template class BarycentricConstraints<2>;
template class BarycentricConstraints<3>;

}  // namespace flbc
