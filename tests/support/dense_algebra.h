// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Decompositions by Eigen of dense matrices of any size. They are compiled once, because each
//! takes seconds to compile.
#pragma once

#include <Eigen/Core>

namespace flbc::testing {

//! The x of least norm that minimizes |a x - b|, for each column of b.
Eigen::MatrixXd least_squares(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b);

//! Solves a x = b. \param a  square, of full rank
Eigen::MatrixXd solve_square(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b);

//! Solves a x = b. \param a  symmetric and definite
Eigen::MatrixXd solve_symmetric(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b);

//! Orthonormal columns that span {x: a x = 0}.
Eigen::MatrixXd null_space(const Eigen::MatrixXd& a);

double determinant(const Eigen::MatrixXd& a);

}  // namespace flbc::testing
