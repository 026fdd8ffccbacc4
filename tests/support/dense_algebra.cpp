// SPDX-License-Identifier: BSD-3-Clause
#include "support/dense_algebra.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <Eigen/QR>

namespace flbc::testing {

Eigen::MatrixXd least_squares(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  return a.completeOrthogonalDecomposition().solve(b);
}

Eigen::MatrixXd solve_square(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  return a.partialPivLu().solve(b);
}

Eigen::MatrixXd solve_symmetric(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  return a.ldlt().solve(b);
}

Eigen::MatrixXd null_space(const Eigen::MatrixXd& a) {
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(a.transpose());
  const Eigen::MatrixXd q = qr.householderQ();
  return q.rightCols(q.cols() - qr.rank());
}

double determinant(const Eigen::MatrixXd& a) {
  return a.determinant();
}

}  // namespace flbc::testing
