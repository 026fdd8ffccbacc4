// SPDX-License-Identifier: BSD-3-Clause
#include "linear/dense.h"

#include <cmath>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/Jacobi>
#include <Eigen/QR>
#include <Eigen/SVD>

#include "base/instantiate.h"

namespace flbc::dense {

using PivotedQr = Eigen::ColPivHouseholderQR<Eigen::MatrixXd>;

// One instantiation for all sizes, without heap allocation.
using SmallMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, 4, 4>;
using SmallVector = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, 4, 1>;

template <int N>
Eigen::Matrix<double, N, 1> solve_symmetric(const Eigen::Matrix<double, N, N>& matrix,
                                            const Eigen::Matrix<double, N, 1>& right_side) {
  const Eigen::LDLT<SmallMatrix> factor{SmallMatrix(matrix)};
  const SmallVector solution = factor.solve(SmallVector(right_side));
  return solution;
}

template Eigen::Vector2d solve_symmetric(const Eigen::Matrix2d&, const Eigen::Vector2d&);
template Eigen::Vector3d solve_symmetric(const Eigen::Matrix3d&, const Eigen::Vector3d&);
template Eigen::Vector4d solve_symmetric(const Eigen::Matrix4d&, const Eigen::Vector4d&);

template <int N>
Eigen::Matrix<double, N, N> gram(const Eigen::Matrix<double, Eigen::Dynamic, N>& a,
                                 const Eigen::Matrix<double, Eigen::Dynamic, N>& b) {
  return a.transpose() * b;
}

template <int N>
Eigen::Matrix<double, N, N> moments(const Eigen::Matrix<double, N, Eigen::Dynamic>& columns) {
  return columns * columns.transpose();
}

template <int N>
Eigen::Matrix<double, N, N> moments(const Eigen::Matrix<double, N, Eigen::Dynamic>& columns,
                                    const Eigen::VectorXd& weights) {
  return columns * weights.asDiagonal() * columns.transpose();
}

template decltype(gram<3>) gram<3>;
template decltype(gram<4>) gram<4>;
template Eigen::Matrix2d moments(const Eigen::Matrix2Xd&);
template Eigen::Matrix3d moments(const Eigen::Matrix3Xd&);
template Eigen::Matrix2d moments(const Eigen::Matrix2Xd&, const Eigen::VectorXd&);
template Eigen::Matrix3d moments(const Eigen::Matrix3Xd&, const Eigen::VectorXd&);

template <int N>
Eigen::Matrix<double, N, N> principal_axes(const Eigen::Matrix<double, N, N>& symmetric) {
  if constexpr (N == 2) {
    Eigen::JacobiRotation<double> turn;
    turn.makeJacobi(symmetric, 0, 1);
    Eigen::Matrix2d axes = Eigen::Matrix2d::Identity();
    axes.applyOnTheRight(0, 1, turn);
    return axes;
  } else {
    return Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, N, N>>(symmetric).eigenvectors();
  }
}

FLBC_INSTANTIATE_FUNCTION(principal_axes)

Eigen::Matrix3d fast_principal_axes(const Eigen::Matrix3d& symmetric) {
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
  return solver.computeDirect(symmetric).eigenvectors();
}

Eigen::MatrixXd least_squares(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b,
                              double threshold) {
  Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> decomposition;
  decomposition.setThreshold(threshold);
  return decomposition.compute(a).solve(b);
}

Eigen::VectorXd solve_normal_equations(const Eigen::MatrixXd& a, const Eigen::VectorXd& b) {
  const PivotedQr qr(a);
  const Eigen::MatrixXd factor = qr.matrixQR().topRows(a.cols());
  const auto upper = factor.triangularView<Eigen::Upper>();
  Eigen::VectorXd x = qr.colsPermutation().transpose() * b;
  x = upper.transpose().solve(x);
  x = upper.solve(x);
  return qr.colsPermutation() * x;
}

Eigen::MatrixXd orthonormal_basis(const Eigen::MatrixXd& columns) {
  Eigen::MatrixXd basis = Eigen::MatrixXd::Identity(columns.rows(), columns.cols());
  const PivotedQr qr(columns);
  basis.applyOnTheLeft(qr.householderQ());
  return basis;
}

double least_pivot(const Eigen::MatrixXd& columns) {
  return std::abs(PivotedQr(columns).matrixQR().diagonal().tail<1>()[0]);
}

Eigen::Matrix3d nearest_rotation(const Eigen::Matrix3d& a) {
  const Eigen::JacobiSVD<Eigen::Matrix3d, Eigen::NoQRPreconditioner> svd(
      a, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Matrix3d u = svd.matrixU();
  if ((u * svd.matrixV().transpose()).determinant() < 0) u.col(2) *= -1;
  return u * svd.matrixV().transpose();
}

}  // namespace flbc::dense
