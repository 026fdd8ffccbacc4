// SPDX-License-Identifier: BSD-3-Clause
// The global linear solve of the splitting methods: direct, or a multigrid cycle if a factor would
// cost more.
#pragma once

#include <numeric>
#include <variant>

#include "flbc/types.h"
#include "linear/linear_solver.h"
#include "linear/multigrid.h"
#include "linear/panel_cholesky.h"

namespace flbc {

template <class Scalar>
class SpdSolver {
 public:
  //! \param matrix  symmetric positive definite, both triangles \param stride  of the rows to solve
  //! for \param kind  kDirect or kMultigrid
  SpdSolver(const RowMatrix& matrix, std::size_t stride, LinearSolver kind)
      : solver_(make(matrix, stride, kind)) {
    if (const auto* cholesky = std::get_if<PanelCholesky<Scalar>>(&solver_)) {
      position_ = cholesky->position();
    } else {
      position_.resize(matrix.rows());
      std::iota(position_.begin(), position_.end(), 0);
    }
  }

  Index size() const { return static_cast<Index>(position_.size()); }

  //! The row of every unknown in the arrays of solve_slice().
  const std::vector<Index>& position() const { return position_; }

  //! Solves, or takes one cycle, for the columns begin .. end - 1, multiples of 8, in the calling
  //! thread and in place; see PanelCholesky and Multigrid.
  void solve_slice(Scalar* rows, std::size_t stride, std::size_t begin, std::size_t end) {
    if (auto* cholesky = std::get_if<PanelCholesky<Scalar>>(&solver_)) {
      cholesky->solve_slice(rows, stride, begin, end);
    } else {
      std::get<Multigrid<Scalar>>(solver_).cycle_slice(rows, begin, end);
    }
  }

 private:
  using Solver = std::variant<PanelCholesky<Scalar>, Multigrid<Scalar>>;
  static Solver make(const RowMatrix& matrix, std::size_t stride, LinearSolver kind) {
    if (kind == LinearSolver::kDirect) return PanelCholesky<Scalar>(matrix);
    return Multigrid<Scalar>(matrix, stride);
  }

  Solver solver_;
  std::vector<Index> position_;
};

}  // namespace flbc
