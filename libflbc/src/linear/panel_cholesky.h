// SPDX-License-Identifier: BSD-3-Clause
// Direct solver for sparse symmetric positive definite systems with many right-hand sides at once,
// one per control point.
#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/SparseCore>

#include "base/aligned_array.h"
#include "base/padded_rows.h"
#include "flbc/types.h"
#include "linear/panel_kernel.h"

namespace flbc {

//! A range of columns.
struct Slice {
  std::size_t begin, end;
};

//! The columns of one thread of a team, from rows of `stride` values. A slice begins at a multiple
//! of 16, so that no two threads write to the same cache line, even in single precision. If there
//! are more threads than slices, some are empty.
//! \param stride  a multiple of 8
Slice slice_of(std::size_t stride, int thread, int num_threads);

//! Factors once, in double precision, and solves often, in the precision Scalar. A solve handles
//! all right-hand sides together: they are the columns of a row-major array, so each value of the
//! factor is loaded once per row.
template <class Scalar>
class PanelCholesky {
 public:
  //! \param matrix  symmetric positive definite; only the lower triangle is read
  //! \param kernel  the loops to use; default: the best for this processor \throws SolverError
  //! naming the size if the matrix is not positive definite
  explicit PanelCholesky(
      const Eigen::SparseMatrix<double>& matrix,
      const panel::Kernel<Scalar>& kernel = select_kernel<panel::Kernel<Scalar>>());

  //! Number of unknowns.
  Index size() const { return static_cast<Index>(position_.size()); }

  //! The row of every unknown in the arrays of solve(), in an order that keeps the factor sparse.
  const std::vector<Index>& position() const { return position_; }

  //! Solves for all columns, in place and in parallel.
  //! \param rows  size() rows of `stride` values, aligned to 64 bytes
  //! \param stride  a multiple of 8
  void solve(Scalar* rows, std::size_t stride) const;

  //! Solves for the columns begin .. end - 1, multiples of 8, in the calling thread. The result of
  //! a column is bit-identical for any slice.
  void solve_slice(Scalar* rows, std::size_t stride, std::size_t begin, std::size_t end) const;

  //! Number of stored values of the factor.
  std::size_t num_entries() const { return entries_.size(); }

 private:
  std::vector<Index> position_;
  std::vector<panel::Panel> panels_;
  std::vector<Index> below_;  // rows of the supernodes; neighboring panels share them
  AlignedArray<Scalar> entries_;
  const panel::Kernel<Scalar>* kernel_;
};

}  // namespace flbc
