// SPDX-License-Identifier: BSD-3-Clause
#include "linear/matrix_arrays.h"

#include "base/parallel.h"

namespace flbc {

template <class Scalar>
MatrixArrays<Scalar>::MatrixArrays(const RowMatrix& matrix)
    : starts(matrix.outerIndexPtr(), matrix.outerIndexPtr() + matrix.rows() + 1),
      columns(matrix.innerIndexPtr(), matrix.innerIndexPtr() + matrix.nonZeros()),
      values(matrix.valuePtr(), matrix.valuePtr() + matrix.nonZeros()) {
}

template <class Scalar>
SweepArrays<Scalar>::SweepArrays(const RowMatrix& matrix)
    : upper(matrix.rows()), inverse_diagonal(matrix.rows()) {
  const auto num_rows = static_cast<Index>(matrix.rows());
  off_diagonal.starts.resize(num_rows + 1);
  off_diagonal.columns.resize(matrix.nonZeros() - num_rows);
  off_diagonal.values.resize(matrix.nonZeros() - num_rows);
  parallel_for(num_rows, [&](Index row) {
    Index place = matrix.outerIndexPtr()[row] - row;  // each previous row has a diagonal entry
    for (RowMatrix::InnerIterator it(matrix, row); it; ++it) {
      const auto column = static_cast<Index>(it.col());
      if (column == row) {
        inverse_diagonal[row] = static_cast<Scalar>(1 / it.value());
        upper[row] = place;
        continue;
      }
      off_diagonal.columns[place] = column;
      off_diagonal.values[place++] = static_cast<Scalar>(it.value());
    }
    off_diagonal.starts[row + 1] = place;
  });
}

RowMatrix reordered(const RowMatrix& matrix, const std::vector<Index>& rows,
                    const std::vector<Index>& columns) {
  const auto num_rows = static_cast<Index>(matrix.rows());
  std::vector<Index> row_at(num_rows);
  for (Index row = 0; row < num_rows; ++row) row_at[rows[row]] = row;
  return assemble_rows(num_rows, static_cast<Index>(matrix.cols()),
                       [&](Index row, const auto& add) {
                         for (RowMatrix::InnerIterator it(matrix, row_at[row]); it; ++it) {
                           add(columns[it.col()], it.value());
                         }
                       });
}

template struct MatrixArrays<float>;
template struct MatrixArrays<double>;
template struct SweepArrays<float>;
template struct SweepArrays<double>;

}  // namespace flbc
