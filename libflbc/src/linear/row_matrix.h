// SPDX-License-Identifier: BSD-3-Clause
// Sparse matrices by rows, assembled by all threads.
#pragma once

#include <algorithm>
#include <numeric>
#include <vector>

#include <Eigen/SparseCore>

#include "base/parallel.h"
#include "flbc/types.h"

namespace flbc {

using RowMatrix = Eigen::SparseMatrix<double, Eigen::RowMajor, Index>;

//! The row of one thread: sums by column.
class SparseRow {
 public:
  explicit SparseRow(Index num_columns) : mark_(num_columns, -1), sum_(num_columns) {}

  //! \param row  a new one \param columns  output for its columns, or null to count
  void begin(Index row, Index* columns) {
    now_ = row;
    columns_ = columns;
    count_ = 0;
  }

  void add(Index column, double value) {
    if (mark_[column] == now_) {
      sum_[column] += value;
      return;
    }
    mark_[column] = now_;
    sum_[column] = value;
    if (columns_ != nullptr) columns_[count_] = column;
    ++count_;
  }

  Index count() const { return count_; }
  double sum_at(Index column) const { return sum_[column]; }

 private:
  std::vector<Index> mark_;
  std::vector<double> sum_;
  Index now_ = -1;
  Index* columns_ = nullptr;
  Index count_ = 0;
};

//! Sums by row and column, bit-identical for any number of threads.
//! \param emit  (row, add): calls add(column, value) for the parts of a row in a fixed order;
//! called twice for each row, by several threads
template <class Emit>
RowMatrix assemble_rows(Index num_rows, Index num_columns, const Emit& emit) {
  RowMatrix matrix(num_rows, num_columns);
  Index* starts = matrix.outerIndexPtr();
  // Calls use(row, sums, columns) for all rows; without `writes`, columns are only counted.
  const auto sum_up = [&](bool writes, const auto& use) {
    parallel_for(num_rows, [&](Index begin, Index end) {
      SparseRow sum(num_columns);
      for (Index row = begin; row < end; ++row) {
        Index* columns = writes ? matrix.innerIndexPtr() + starts[row] : nullptr;
        sum.begin(row, columns);
        emit(row, [&](Index column, double value) { sum.add(column, value); });
        use(row, sum, columns);
      }
    });
  };
  sum_up(false, [&](Index row, const SparseRow& sum, Index*) { starts[row + 1] = sum.count(); });
  std::partial_sum(starts, starts + num_rows + 1, starts);
  matrix.resizeNonZeros(starts[num_rows]);
  sum_up(true, [&](Index row, const SparseRow& sum, Index* columns) {
    std::sort(columns, columns + sum.count());
    double* values = matrix.valuePtr() + starts[row];
    for (Index k = 0; k < sum.count(); ++k) values[k] = sum.sum_at(columns[k]);
  });
  return matrix;
}

//! A B.
inline RowMatrix product(const RowMatrix& a, const RowMatrix& b) {
  return assemble_rows(static_cast<Index>(a.rows()), static_cast<Index>(b.cols()),
                       [&](Index row, const auto& add) {
                         for (RowMatrix::InnerIterator of_a(a, row); of_a; ++of_a) {
                           for (RowMatrix::InnerIterator of_b(b, of_a.col()); of_b; ++of_b) {
                             add(static_cast<Index>(of_b.col()), of_a.value() * of_b.value());
                           }
                         }
                       });
}

}  // namespace flbc
