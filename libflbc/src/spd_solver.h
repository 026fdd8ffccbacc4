// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Direct solver for sparse symmetric positive definite systems with many right-hand sides.
#pragma once

#include <memory>

#include <Eigen/SparseCore>

namespace flbc {

//! Factors once, solves often. CHOLMOD's supernodal Cholesky where the library was built with it,
//! Eigen's LDL^T otherwise.
class SpdSolver {
 public:
  //! \param matrix  symmetric positive definite; only the lower triangle is read
  //! \throws SolverError if the matrix is not positive definite
  explicit SpdSolver(const Eigen::SparseMatrix<double>& matrix);
  ~SpdSolver();
  SpdSolver(SpdSolver&&) noexcept;
  SpdSolver& operator=(SpdSolver&&) noexcept;

  //! Solves for every column of the right-hand side.
  Eigen::MatrixXd solve(const Eigen::MatrixXd& right_hand_side) const;

 private:
  struct Factor;
  std::unique_ptr<Factor> factor_;
};

}  // namespace flbc
