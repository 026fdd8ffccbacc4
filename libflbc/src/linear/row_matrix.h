// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Sparse matrices by rows, assembled by all threads.
#pragma once

#include <omp.h>

#include <algorithm>
#include <numeric>
#include <vector>

#include <Eigen/SparseCore>

#include "flbc/types.h"

namespace flbc {

using RowMatrix = Eigen::SparseMatrix<double, Eigen::RowMajor, Index>;

//! The row of one thread: sums by column.
class RowSum {
 public:
  explicit RowSum(Index num_columns) : mark_(num_columns, -1), sum_(num_columns) {}

  //! Begins a row. \param mark  unique per row \param columns  output for its columns, or null to
  //! count
  void begin(Index mark, Index* columns) {
    now_ = mark;
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
//! called twice for each row, by several threads; must not throw
template <class Emit>
RowMatrix assemble_rows(Index num_rows, Index num_columns, const Emit& emit) {
  constexpr Index kFewest = 1000;  // minimum number of rows for several threads
  const int threads = num_rows < kFewest ? 1 : omp_get_max_threads();
  // Memory is allocated outside the parallel loops, which must not throw.
  std::vector<RowSum> sums(threads, RowSum(num_columns));
  const auto sum_up = [&](Index row, Index mark, Index* columns) -> RowSum& {
    RowSum& sum = sums[omp_get_thread_num()];
    sum.begin(mark, columns);
    emit(row, [&](Index column, double value) { sum.add(column, value); });
    return sum;
  };
  RowMatrix matrix(num_rows, num_columns);
  Index* starts = matrix.outerIndexPtr();
#pragma omp parallel for schedule(static) num_threads(threads)
  for (Index row = 0; row < num_rows; ++row) starts[row + 1] = sum_up(row, row, nullptr).count();
  std::partial_sum(starts, starts + num_rows + 1, starts);
  matrix.resizeNonZeros(starts[num_rows]);
#pragma omp parallel for schedule(static) num_threads(threads)
  for (Index row = 0; row < num_rows; ++row) {
    Index* columns = matrix.innerIndexPtr() + starts[row];
    const RowSum& sum = sum_up(row, num_rows + row, columns);
    std::sort(columns, columns + sum.count());
    double* values = matrix.valuePtr() + starts[row];
    for (Index k = 0; k < sum.count(); ++k) values[k] = sum.sum_at(columns[k]);
  }
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
