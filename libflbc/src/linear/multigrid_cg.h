// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Conjugate gradients with a multigrid cycle as preconditioner, for many right-hand sides at once:
//! accurate solutions in time and memory proportional to the size of the matrix.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "linear/multigrid.h"

namespace flbc {

class MultigridCg {
 public:
  //! \param matrix  symmetric positive definite, both triangles
  explicit MultigridCg(const RowMatrix& matrix);

  //! Number of unknowns.
  Index size() const { return static_cast<Index>(position_.size()); }

  //! The row of every unknown: its own.
  const std::vector<Index>& position() const { return position_; }

  //! Solves for all columns, in place and in parallel, until the error of each has shrunk to about
  //! 1e-7 of what it was with zero, in the energy norm. A column's result is the same, to the last
  //! bit, for any number of threads. The hierarchy is made by the first solve, and kept; not for
  //! several threads at a time.
  //! \param rows  size() rows of `stride` numbers, aligned to 64 bytes
  //! \param stride  a multiple of 8
  void solve(double* rows, std::size_t stride) const;

 private:
  RowMatrix matrix_;
  std::vector<Index> position_;
  mutable std::optional<Multigrid<double>> multigrid_;  // of the stride that was solved for last
  mutable std::size_t stride_ = 0;
};

}  // namespace flbc
