// SPDX-License-Identifier: BSD-3-Clause
// Conjugate gradients with a multigrid cycle as preconditioner, for many right-hand sides at once:
// accurate solutions in time and memory proportional to the size of the matrix.
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

  //! The row of every unknown: the identity.
  const std::vector<Index>& position() const { return position_; }

  //! Solves for all columns, in place and in parallel, until the energy norm of each error is about
  //! 1e-7 of its initial value at zero. The result is bit-identical for any number of threads. The
  //! first solve builds the hierarchy; not thread-safe.
  //! \param rows  size() rows of `stride` values, aligned to 64 bytes
  //! \param stride  a multiple of 8
  void solve(double* rows, std::size_t stride) const;

 private:
  RowMatrix matrix_;
  std::vector<Index> position_;
  mutable std::optional<Multigrid<double>> multigrid_;  // for the last stride
  mutable std::size_t stride_ = 0;
};

}  // namespace flbc
