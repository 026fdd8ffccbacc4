// SPDX-License-Identifier: BSD-3-Clause
#include "linear/matrix_arrays.h"

namespace flbc {

template <class Scalar>
MatrixArrays<Scalar>::MatrixArrays(const RowMatrix& matrix) {
  for (Index row = 0; row < matrix.rows(); ++row) {
    for (RowMatrix::InnerIterator it(matrix, row); it; ++it) {
      columns.push_back(static_cast<Index>(it.col()));
      values.push_back(static_cast<Scalar>(it.value()));
    }
    starts.push_back(static_cast<Index>(columns.size()));
  }
}

template <class Scalar>
SweepArrays<Scalar>::SweepArrays(const RowMatrix& matrix) {
  for (Index row = 0; row < matrix.rows(); ++row) {
    for (RowMatrix::InnerIterator it(matrix, row); it; ++it) {
      const auto column = static_cast<Index>(it.col());
      if (column == row) {
        inverse_diagonal.push_back(static_cast<Scalar>(1 / it.value()));
        upper.push_back(static_cast<Index>(off_diagonal.columns.size()));
        continue;
      }
      off_diagonal.columns.push_back(column);
      off_diagonal.values.push_back(static_cast<Scalar>(it.value()));
    }
    off_diagonal.starts.push_back(static_cast<Index>(off_diagonal.columns.size()));
  }
}

RowMatrix reordered(const RowMatrix& matrix, const std::vector<Index>& rows,
                    const std::vector<Index>& columns) {
  std::vector<Eigen::Triplet<double, Index>> entries;
  entries.reserve(matrix.nonZeros());
  for (Index row = 0; row < matrix.rows(); ++row) {
    for (RowMatrix::InnerIterator it(matrix, row); it; ++it) {
      entries.emplace_back(rows[row], columns[it.col()], it.value());
    }
  }
  RowMatrix moved(matrix.rows(), matrix.cols());
  moved.setFromTriplets(entries.begin(), entries.end());
  return moved;
}

template struct MatrixArrays<float>;
template struct MatrixArrays<double>;
template struct SweepArrays<float>;
template struct SweepArrays<double>;

}  // namespace flbc
