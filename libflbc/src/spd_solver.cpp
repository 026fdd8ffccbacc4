// SPDX-License-Identifier: BSD-3-Clause
#include "spd_solver.h"

#ifdef FLBC_WITH_CHOLMOD
#include <Eigen/CholmodSupport>
#else
#include <Eigen/SparseCholesky>
#endif

#include "flbc/errors.h"

namespace flbc {

struct SpdSolver::Factor {
#ifdef FLBC_WITH_CHOLMOD
  Eigen::CholmodSupernodalLLT<Eigen::SparseMatrix<double>, Eigen::Lower> cholesky;
  // CHOLMOD reports a matrix that is not positive definite on standard output unless told not to.
  Factor() {
    cholesky.cholmod().print = 0;
  }
#else
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>, Eigen::Lower> cholesky;
#endif
};

SpdSolver::SpdSolver(const Eigen::SparseMatrix<double>& matrix)
    : factor_(std::make_unique<Factor>()) {
  factor_->cholesky.compute(matrix);
  if (factor_->cholesky.info() != Eigen::Success) {
    throw SolverError("a linear system with " + std::to_string(matrix.rows()) +
                      " unknowns cannot be factored: it is not positive definite");
  }
}

SpdSolver::~SpdSolver() = default;
SpdSolver::SpdSolver(SpdSolver&&) noexcept = default;
SpdSolver& SpdSolver::operator=(SpdSolver&&) noexcept = default;

Eigen::MatrixXd SpdSolver::solve(const Eigen::MatrixXd& right_hand_side) const {
  return factor_->cholesky.solve(right_hand_side);
}

}  // namespace flbc
