// SPDX-License-Identifier: BSD-3-Clause
#include "linear/multigrid.h"

#include <numeric>

#include "linear/aggregation.h"

namespace flbc {
namespace {

// Small enough for a cheap factor.
constexpr Index kCoarsest = 2000;

// Permutes columns to the order of the direct solver.
RowMatrix with_columns_at(const RowMatrix& matrix, const std::vector<Index>& position) {
  std::vector<Index> rows(matrix.rows());
  std::iota(rows.begin(), rows.end(), 0);
  return reordered(matrix, rows, position);
}

}  // namespace

template <class Scalar>
Multigrid<Scalar>::LevelData::LevelData(const RowMatrix& fine, const RowMatrix& to_fine)
    : matrix(fine), prolongation(to_fine), coarse_size(static_cast<Index>(to_fine.cols())) {
}

template <class Scalar>
multigrid::Level<Scalar> Multigrid<Scalar>::LevelData::view() const {
  const auto rows = [](const MatrixArrays<Scalar>& arrays) -> multigrid::Rows<Scalar> {
    return {arrays.starts.data(), arrays.columns.data(), arrays.values.data()};
  };
  return {static_cast<Index>(matrix.inverse_diagonal.size()),
          coarse_size,
          rows(matrix.off_diagonal),
          matrix.upper.data(),
          matrix.inverse_diagonal.data(),
          rows(prolongation)};
}

template <class Scalar>
Multigrid<Scalar>::Multigrid(RowMatrix matrix, std::size_t stride)
    : stride_(stride),
      kernel_(select_kernel<multigrid::Kernel<Scalar>>()),
      size_(static_cast<Index>(matrix.rows())) {
  const auto entries = static_cast<double>(matrix.nonZeros());
  complexity_ = 1;
  while (!coarsest_) {
    RowMatrix prolongation = smoothed_prolongation(matrix);
    RowMatrix coarse = coarse_matrix(matrix, prolongation);
    complexity_ += static_cast<double>(coarse.nonZeros()) / entries;
    // Unknowns without couplings cannot be grouped.
    const bool stalls = 5 * coarse.rows() > 4 * matrix.rows();
    if (coarse.rows() <= kCoarsest || stalls) {
      coarsest_.emplace(Eigen::SparseMatrix<double>(coarse));
      prolongation = with_columns_at(prolongation, coarsest_->position());
    }
    levels_.emplace_back(matrix, prolongation);
    levels_.back().solution = AlignedArray<Scalar>(matrix.rows() * stride);
    if (levels_.size() > 1) {
      levels_.back().right_side = AlignedArray<Scalar>(matrix.rows() * stride);
    }
    matrix.swap(coarse);
  }
  coarsest_rows_ = AlignedArray<Scalar>(matrix.rows() * stride);
}

template <class Scalar>
void Multigrid<Scalar>::cycle_slice(Scalar* rows, std::size_t begin, std::size_t end) {
  const std::size_t num_levels = levels_.size();
  const auto vectors = [&](std::size_t l) -> multigrid::Vectors<Scalar> {
    return {l == 0 ? rows : levels_[l].right_side.data(),
            levels_[l].solution.data(),
            l + 1 < num_levels ? levels_[l + 1].right_side.data() : coarsest_rows_.data(),
            stride_,
            begin,
            end};
  };
  for (std::size_t l = 0; l < num_levels; ++l) kernel_.descend(levels_[l].view(), vectors(l));
  coarsest_->solve_slice(coarsest_rows_.data(), stride_, begin, end);
  for (std::size_t l = num_levels; l-- > 0;) kernel_.ascend(levels_[l].view(), vectors(l));
}

template class Multigrid<float>;
template class Multigrid<double>;

}  // namespace flbc
