// SPDX-License-Identifier: BSD-3-Clause
#include "linear/multigrid.h"

#include <utility>

namespace flbc {
namespace {

// Small enough for a factor that costs next to nothing.
constexpr Index kCoarsest = 2000;

// Columns into the order of the direct solver, which has its own.
RowMatrix with_columns_at(const RowMatrix& matrix, const std::vector<Index>& position) {
  std::vector<Eigen::Triplet<double, Index>> entries;
  entries.reserve(matrix.nonZeros());
  for (Index row = 0; row < matrix.rows(); ++row) {
    for (RowMatrix::InnerIterator it(matrix, row); it; ++it) {
      entries.emplace_back(row, position[it.col()], it.value());
    }
  }
  RowMatrix moved(matrix.rows(), matrix.cols());
  moved.setFromTriplets(entries.begin(), entries.end());
  return moved;
}

}  // namespace

template <class Scalar>
Multigrid<Scalar>::LevelData::LevelData(const RowMatrix& matrix, const RowMatrix& prolongation)
    : starts{0}, prolongation_starts{0}, coarse_size(static_cast<Index>(prolongation.cols())) {
  for (Index row = 0; row < matrix.rows(); ++row) {
    for (RowMatrix::InnerIterator it(matrix, row); it; ++it) {
      const auto column = static_cast<Index>(it.col());
      if (column == row) {
        inverse_diagonal.push_back(static_cast<Scalar>(1 / it.value()));
        upper.push_back(static_cast<Index>(columns.size()));
        continue;
      }
      columns.push_back(column);
      values.push_back(static_cast<Scalar>(it.value()));
    }
    starts.push_back(static_cast<Index>(columns.size()));
    for (RowMatrix::InnerIterator it(prolongation, row); it; ++it) {
      prolongation_columns.push_back(static_cast<Index>(it.col()));
      prolongation_values.push_back(static_cast<Scalar>(it.value()));
    }
    prolongation_starts.push_back(static_cast<Index>(prolongation_columns.size()));
  }
}

template <class Scalar>
multigrid::Level<Scalar> Multigrid<Scalar>::LevelData::view() const {
  return {static_cast<Index>(inverse_diagonal.size()),
          coarse_size,
          {starts.data(), columns.data(), values.data()},
          upper.data(),
          inverse_diagonal.data(),
          {prolongation_starts.data(), prolongation_columns.data(), prolongation_values.data()}};
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
    RowMatrix coarse = prolongation.transpose() * RowMatrix(matrix * prolongation);
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
    matrix = std::move(coarse);
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
