// SPDX-License-Identifier: BSD-3-Clause
// An approximate solver for sparse symmetric positive definite systems with many right-hand sides
// at once, in time and memory proportional to the size of the matrix. It replaces the direct
// solver on large meshes.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "base/aligned_array.h"
#include "flbc/types.h"
#include "linear/matrix_arrays.h"
#include "linear/multigrid_kernel.h"
#include "linear/panel_cholesky.h"

namespace flbc {

//! One symmetric cycle B^-1 b of algebraic multigrid: a Gauss-Seidel sweep, the solution on coarser
//! unknowns, the sweep in reverse. It is linear, and 0 < B^-1 A <= 1 in the energy norm, so a
//! splitting method still converges if it replaces the exact solve.
template <class Scalar>
class Multigrid {
 public:
  //! \param matrix  symmetric positive definite, both triangles
  //! \param stride  of the right-hand sides, a multiple of 8
  Multigrid(RowMatrix matrix, std::size_t stride);

  //! Number of unknowns.
  Index size() const { return size_; }

  //! One cycle for the columns begin .. end - 1, multiples of 8, in the calling thread and in
  //! place. Slices of several threads must not overlap. The result of a column is bit-identical for
  //! any slice. \param rows  size() rows of `stride` values, aligned to 64 bytes
  void cycle_slice(Scalar* rows, std::size_t begin, std::size_t end);

  //! Stored values of all matrices, relative to the given matrix.
  double operator_complexity() const { return complexity_; }

 private:
  struct LevelData {
    SweepArrays<Scalar> matrix;
    MatrixArrays<Scalar> prolongation;
    Index coarse_size;
    AlignedArray<Scalar> right_side;  // empty on the finest level
    AlignedArray<Scalar> solution;

    LevelData(const RowMatrix& fine, const RowMatrix& to_fine);
    multigrid::Level<Scalar> view() const;
  };

  const std::size_t stride_;
  const multigrid::Kernel<Scalar>& kernel_;
  Index size_ = 0;
  double complexity_ = 0;
  std::vector<LevelData> levels_;
  std::optional<PanelCholesky<Scalar>> coarsest_;
  AlignedArray<Scalar> coarsest_rows_;
};

}  // namespace flbc
