// SPDX-License-Identifier: BSD-3-Clause
// Sparse matrices as plain arrays for inner loops.
#pragma once

#include <vector>

#include "linear/row_matrix.h"

namespace flbc {

//! A matrix by rows.
template <class Scalar>
struct MatrixArrays {
  std::vector<Index> starts{0};  //!< rows + 1
  std::vector<Index> columns;    //!< ascending in each row
  std::vector<Scalar> values;

  MatrixArrays() = default;
  explicit MatrixArrays(const RowMatrix& matrix);
};

//! L + L^T and D^-1 of a matrix A = L + D + L^T, for sweeps over its rows.
template <class Scalar>
struct SweepArrays {
  MatrixArrays<Scalar> off_diagonal;
  std::vector<Index> upper;  //!< start of the entries right of the diagonal in each row
  std::vector<Scalar> inverse_diagonal;

  SweepArrays() = default;
  //! \param matrix  with a full diagonal
  explicit SweepArrays(const RowMatrix& matrix);
};

//! The matrix with row i at rows[i] and column j at columns[j].
RowMatrix reordered(const RowMatrix& matrix, const std::vector<Index>& rows,
                    const std::vector<Index>& columns);

}  // namespace flbc
