// SPDX-License-Identifier: BSD-3-Clause
#include "solver/methods/active_set/active_multigrid.h"

#include <algorithm>
#include <utility>

#include "base/flush_denormals.h"
#include "base/padded_rows.h"

namespace flbc::active_set {
namespace {

// Fewer unknowns are swept as fast as they are solved for.
constexpr Index kCoarsest = 16;

template <class Scalar>
Entries<Scalar> all_of(const MatrixArrays<Scalar>& arrays) {
  return {arrays.starts.data(), arrays.starts.data() + 1, arrays.columns.data(),
          arrays.values.data()};
}

}  // namespace

template <class Scalar, int Dim>
ActiveMultigrid<Scalar, Dim>::ActiveMultigrid(RowMatrix matrix, const SweepOrder& order,
                                              const PackedLists& lists,
                                              const AlignedArray<Scalar>& basis,
                                              const PointList<Dim>& control_points,
                                              const Kernel<Scalar, Dim>& kernel)
    : kernel_(kernel),
      n_(static_cast<ControlPoint>(control_points.cols())),
      work_size_(padded(static_cast<std::size_t>(n_) + 1)),
      lists_(lists),
      basis_(basis) {
  LevelData level;
  level.order = order;
  for (;;) {
    const PackedLists& fine = levels_.empty() ? lists_ : level.own_lists;
    level.matrix =
        SweepArrays<Scalar>(reordered(matrix, level.order.position, level.order.position));
    level.solution = AlignedArray<Scalar>(fine.size());
    LevelData next = coarsen(matrix, fine, level);
    const bool is_last = next.own_lists.size() == 0;
    if (!is_last)
      next.own_basis = row_bases<Scalar, Dim>(next.own_lists, control_points, {}, nullptr);
    levels_.push_back(std::move(level));
    if (is_last) return;
    level = std::move(next);
  }
}

// Without lists if there is nothing to gain. \param matrix  becomes the coarse one
template <class Scalar, int Dim>
typename ActiveMultigrid<Scalar, Dim>::LevelData ActiveMultigrid<Scalar, Dim>::coarsen(
    RowMatrix& matrix, const PackedLists& lists, LevelData& level) const {
  LevelData next;
  if (matrix.rows() <= kCoarsest) return next;
  const RowMatrix prolongation = smoothed_prolongation(matrix);
  RowMatrix coarse = coarse_matrix(matrix, prolongation);
  // Unknowns without couplings cannot be grouped.
  if (5 * coarse.rows() > 4 * matrix.rows()) return next;
  next.order = sweep_order(coarse);
  const RowMatrix moved = reordered(prolongation, level.order.position, next.order.position);
  const RowMatrix restriction = moved.transpose();
  next.own_lists = coarse_lists(lists, restriction);
  if (next.own_lists.size() == 0) return next;
  level.prolongation = MatrixArrays<Scalar>(moved);
  level.restriction = MatrixArrays<Scalar>(restriction);
  next.right_side = AlignedArray<Scalar>(next.own_lists.size());
  level.rest = AlignedArray<Scalar>(lists.size());
  matrix.swap(coarse);
  return next;
}

// The control points that are active at every vertex of a coarse unknown's function; none where
// their number leaves no freedom.
template <class Scalar, int Dim>
PackedLists ActiveMultigrid<Scalar, Dim>::coarse_lists(const PackedLists& fine,
                                                       const RowMatrix& restriction) const {
  PackedLists lists;
  std::vector<Index> found(n_);
  std::vector<ControlPoint> common;
  for (Index row = 0; row < restriction.rows(); ++row) {
    std::fill(found.begin(), found.end(), 0);
    Index count = 0;
    for (RowMatrix::InnerIterator it(restriction, row); it; ++it, ++count) {
      const std::size_t start = fine.starts[it.col()];
      for (Index j = 0; j < fine.counts[it.col()]; ++j) ++found[fine.items[start + j]];
    }
    common.clear();
    for (Index i = 0; i < n_; ++i) {
      if (found[i] == count) common.push_back(static_cast<ControlPoint>(i));
    }
    if (common.size() <= Dim + 1) common.clear();
    lists.append(common.data(), common.data() + common.size(), n_);
  }
  return lists;
}

template <class Scalar, int Dim>
Level<Scalar> ActiveMultigrid<Scalar, Dim>::view(std::size_t l, const Scalar* right_side) {
  LevelData& level = levels_[l];
  Level<Scalar> view;
  view.lists = l == 0 ? lists_.view() : level.own_lists.view();
  const auto& rows = level.matrix.off_diagonal;
  const Index* upper = level.matrix.upper.data();
  view.lower = {rows.starts.data(), upper, rows.columns.data(), rows.values.data()};
  view.upper = {upper, rows.starts.data() + 1, rows.columns.data(), rows.values.data()};
  view.inverse_diagonal = level.matrix.inverse_diagonal.data();
  view.basis = l == 0 ? basis_.data() : level.own_basis.data();
  view.right_side = l == 0 ? right_side : level.right_side.data();
  view.solution = level.solution.data();
  return view;
}

// Calls body(begin, end) for the rows of every block of a colour, by all threads of the team.
template <class Scalar, int Dim>
template <class Body>
void ActiveMultigrid<Scalar, Dim>::for_blocks(const LevelData& level, std::size_t colour,
                                              const Body& body) const {
  const auto& order = level.order;
#pragma omp for schedule(static)
  for (Index block = order.colour_starts[colour]; block < order.colour_starts[colour + 1];
       ++block) {
    body(order.block_starts[block], order.block_starts[block + 1]);
  }
}

// Down to the next level: once a row has been relaxed, its residual is what later rows did to it,
// but for a part that the projection takes away.
template <class Scalar, int Dim>
void ActiveMultigrid<Scalar, Dim>::descend(std::size_t l, const Scalar* right_side, Scalar* work) {
  LevelData& level = levels_[l];
  const auto fine = view(l, right_side);
  const std::size_t num_colours = level.order.colour_starts.size() - 1;
  for (std::size_t colour = 0; colour < num_colours; ++colour) {
    for_blocks(level, colour, [&](Index begin, Index end) {
      kernel_.descend(fine, begin, end, work_size_, work);
    });
  }
  if (l + 1 == levels_.size()) return;
  const auto num_rows = static_cast<Index>(level.matrix.inverse_diagonal.size());
#pragma omp for schedule(static)
  for (Index begin = 0; begin < num_rows; begin += kRowBlock) {
    kernel_.multiply(fine.upper, fine.lists, fine.lists, -1, fine.solution, false,
                     level.rest.data(), begin, std::min(num_rows, begin + kRowBlock), work_size_,
                     work);
  }
  LevelData& coarse = levels_[l + 1];
  const auto num_coarse = static_cast<Index>(coarse.matrix.inverse_diagonal.size());
#pragma omp for schedule(static)
  for (Index begin = 0; begin < num_coarse; begin += kRowBlock) {
    kernel_.multiply(all_of(level.restriction), coarse.own_lists.view(), fine.lists, 1,
                     level.rest.data(), false, coarse.right_side.data(), begin,
                     std::min(num_coarse, begin + kRowBlock), work_size_, work);
  }
}

template <class Scalar, int Dim>
void ActiveMultigrid<Scalar, Dim>::ascend(std::size_t l, const Scalar* right_side, Scalar* work) {
  LevelData& level = levels_[l];
  const auto fine = view(l, right_side);
  if (l + 1 < levels_.size()) {
    const LevelData& coarse = levels_[l + 1];
    const auto num_rows = static_cast<Index>(level.matrix.inverse_diagonal.size());
#pragma omp for schedule(static)
    for (Index begin = 0; begin < num_rows; begin += kRowBlock) {
      kernel_.multiply(all_of(level.prolongation), fine.lists, coarse.own_lists.view(), 1,
                       coarse.solution.data(), true, fine.solution, begin,
                       std::min(num_rows, begin + kRowBlock), work_size_, work);
    }
  }
  for (std::size_t colour = level.order.colour_starts.size() - 1; colour-- > 0;) {
    for_blocks(level, colour,
               [&](Index begin, Index end) { kernel_.ascend(fine, begin, end, work_size_, work); });
  }
}

template <class Scalar, int Dim>
void ActiveMultigrid<Scalar, Dim>::cycle(Scalar* rows) {
#pragma omp parallel
  {
    const FlushDenormals flush;
    AlignedArray<Scalar> work(2 * work_size_);
    for (std::size_t l = 0; l < levels_.size(); ++l) descend(l, rows, work.data());
    for (std::size_t l = levels_.size(); l-- > 0;) ascend(l, rows, work.data());
  }
  const auto num_unknowns = levels_.front().matrix.inverse_diagonal.size();
  std::copy_n(levels_.front().solution.data(), lists_.starts[num_unknowns], rows);
}

template class ActiveMultigrid<float, 2>;
template class ActiveMultigrid<float, 3>;
template class ActiveMultigrid<double, 2>;
template class ActiveMultigrid<double, 3>;

}  // namespace flbc::active_set
