// SPDX-License-Identifier: BSD-3-Clause
#include "barycentric_constraints.h"

#include <Eigen/LU>
#include <Eigen/QR>

namespace flbc {

template <int Dim>
BarycentricConstraints<Dim>::BarycentricConstraints(const PointList<Dim>& control_points) {
  Eigen::Matrix<double, Eigen::Dynamic, Dim + 1> matrix(control_points.cols(), Dim + 1);
  matrix.col(0).setOnes();
  matrix.template rightCols<Dim>() = control_points.transpose();
  basis_ = Eigen::HouseholderQR<decltype(matrix)>(matrix).householderQ() *
           decltype(matrix)::Identity(matrix.rows(), Dim + 1);
  inverse_r_transposed_ = (basis_.transpose() * matrix).inverse().transpose();
}

template <int Dim>
Eigen::Matrix<double, Dim + 1, Dim> BarycentricConstraints<Dim>::gradient_target() const {
  return inverse_r_transposed_.template rightCols<Dim>();
}

template class BarycentricConstraints<2>;
template class BarycentricConstraints<3>;

}  // namespace flbc
