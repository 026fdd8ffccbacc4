// SPDX-License-Identifier: BSD-3-Clause
// Decompositions of small dense matrices. They are compiled separately, because they take long to
// compile.
#pragma once

#include <Eigen/Core>

namespace flbc::dense {

//! Solves a symmetric, positive semidefinite system. N = 2, 3, 4.
template <int N>
Eigen::Matrix<double, N, 1> solve_symmetric(const Eigen::Matrix<double, N, N>& matrix,
                                            const Eigen::Matrix<double, N, 1>& right_side);

//! a^T b of matrices with few columns. N = 3, 4.
template <int N>
Eigen::Matrix<double, N, N> gram(const Eigen::Matrix<double, Eigen::Dynamic, N>& a,
                                 const Eigen::Matrix<double, Eigen::Dynamic, N>& b);

//! The sum of x x^T over the columns x. N = 2, 3.
template <int N>
Eigen::Matrix<double, N, N> moments(const Eigen::Matrix<double, N, Eigen::Dynamic>& columns);

//! The sum of w x x^T over the columns x and their weights w. N = 2, 3.
template <int N>
Eigen::Matrix<double, N, N> moments(const Eigen::Matrix<double, N, Eigen::Dynamic>& columns,
                                    const Eigen::VectorXd& weights);

//! Orthonormal eigenvectors of a symmetric matrix, one per column. N = 2, 3.
template <int N>
Eigen::Matrix<double, N, N> principal_axes(const Eigen::Matrix<double, N, N>& symmetric);

//! The same for N = 3, four times as fast, to 1e-8 instead of rounding.
Eigen::Matrix3d fast_principal_axes(const Eigen::Matrix3d& symmetric);

//! The x of least norm that minimizes |a x - b|, for each column of b. \param threshold  smaller
//! pivots, relative to the largest, count as zero
Eigen::MatrixXd least_squares(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b,
                              double threshold = 1e-15);

//! Solves a^T a x = b, to the accuracy of a rather than of a^T a. \param a  of full column rank
Eigen::VectorXd solve_normal_equations(const Eigen::MatrixXd& a, const Eigen::VectorXd& b);

//! An orthonormal basis of the span of independent columns.
Eigen::MatrixXd orthonormal_basis(const Eigen::MatrixXd& columns);

//! A measure of linear independence of the columns: the last pivot of an orthogonal decomposition.
//! For few columns it is at most sqrt(columns) times the smallest singular value.
double least_pivot(const Eigen::MatrixXd& columns);

//! The rotation R that maximizes trace(R^T a).
Eigen::Matrix3d nearest_rotation(const Eigen::Matrix3d& a);

}  // namespace flbc::dense
