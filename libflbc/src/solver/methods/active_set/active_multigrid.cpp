// SPDX-License-Identifier: BSD-3-Clause
#include "solver/methods/active_set/active_multigrid.h"

#include <omp.h>

#include <algorithm>
#include <utility>

#include "base/flush_denormals.h"
#include "base/instantiate.h"
#include "base/padded_rows.h"
#include "base/team_size.h"
#include "linear/aggregation.h"

namespace flbc::active_set {
namespace {

// For fewer unknowns a sweep is as fast as a solve.
constexpr Index kCoarsest = 16;

// Rows of a product that a thread takes at a time.
constexpr Index kRowBlock = 64;

template <class Scalar>
Entries<Scalar> all_of(const MatrixArrays<Scalar>& arrays) {
  return {arrays.starts.data(), arrays.starts.data() + 1, arrays.columns.data(),
          arrays.values.data()};
}

// Small enough for many blocks per color, large enough that neighbors are in the cache.
constexpr Index kBlock = 32;

// The smallest color that no coupled block has.
std::vector<Index> colours_of_blocks(const RowMatrix& matrix, Index num_blocks) {
  constexpr Index kNone = -1;
  std::vector<Index> colour(num_blocks, kNone);
  std::vector<Index> taken_by;  // per color: the last block that may not have it
  for (Index block = 0; block < num_blocks; ++block) {
    const auto end = std::min<Index>((block + 1) * kBlock, static_cast<Index>(matrix.rows()));
    for (Index row = block * kBlock; row < end; ++row) {
      for (RowMatrix::InnerIterator it(matrix, row); it; ++it) {
        const Index other = colour[it.col() / kBlock];
        if (other != kNone) taken_by[other] = block;
      }
    }
    const auto free =
        std::find_if(taken_by.begin(), taken_by.end(), [&](Index taken) { return taken != block; });
    colour[block] = static_cast<Index>(free - taken_by.begin());
    if (free == taken_by.end()) taken_by.push_back(kNone);
  }
  return colour;
}

// Calls body(begin, end) for the rows of every block of a color, by all threads of the team.
template <class Body>
void for_blocks(const SweepOrder& order, std::size_t colour, const Body& body) {
#pragma omp for schedule(static)
  for (Index block = order.colour_starts[colour]; block < order.colour_starts[colour + 1];
       ++block) {
    body(order.block_starts[block], order.block_starts[block + 1]);
  }
}

}  // namespace

SweepOrder sweep_order(const RowMatrix& matrix) {
  const auto size = static_cast<Index>(matrix.rows());
  const Index num_blocks = (size + kBlock - 1) / kBlock;
  const auto colour = colours_of_blocks(matrix, num_blocks);
  std::vector<Index> blocks(num_blocks);
  for (Index block = 0; block < num_blocks; ++block) blocks[block] = block;
  std::stable_sort(blocks.begin(), blocks.end(),
                   [&](Index a, Index b) { return colour[a] < colour[b]; });
  SweepOrder order;
  order.position.resize(size);
  Index next = 0;
  for (Index place = 0; place < num_blocks; ++place) {
    const Index block = blocks[place];
    if (place == 0 || colour[block] != colour[blocks[place - 1]]) {
      order.colour_starts.push_back(place);
    }
    order.block_starts.push_back(next);
    const Index end = std::min((block + 1) * kBlock, size);
    for (Index unknown = block * kBlock; unknown < end; ++unknown) order.position[unknown] = next++;
  }
  order.block_starts.push_back(next);
  order.colour_starts.push_back(num_blocks);
  return order;
}

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

// Returns no lists if a coarse level does not pay. \param matrix  becomes the coarse one
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

// The control points that are active at every vertex in the support of a coarse function; none if
// there are too few for a correction.
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
    lists.append({common.data(), common.data() + common.size()}, n_);
  }
  return lists;
}

template <class Scalar, int Dim>
Level<Scalar> ActiveMultigrid<Scalar, Dim>::view(std::size_t l, const Scalar* right_side) {
  LevelData& level = levels_[l];
  const auto& rows = level.matrix.off_diagonal;
  const Index* upper = level.matrix.upper.data();
  Level<Scalar> view;
  view.lists = l == 0 ? lists_.view() : level.own_lists.view();
  view.lower = {rows.starts.data(), upper, rows.columns.data(), rows.values.data()};
  view.upper = {upper, rows.starts.data() + 1, rows.columns.data(), rows.values.data()};
  view.inverse_diagonal = level.matrix.inverse_diagonal.data();
  view.basis = l == 0 ? basis_.data() : level.own_basis.data();
  view.right_side = l == 0 ? right_side : level.right_side.data();
  view.solution = level.solution.data();
  return view;
}

// The product of the kernel, by all threads of the team.
template <class Scalar, int Dim>
void ActiveMultigrid<Scalar, Dim>::multiply(const Entries<Scalar>& entries,
                                            const Lists& target_lists, const Lists& source_lists,
                                            Scalar factor, const Scalar* source, bool adds,
                                            Scalar* target, Index num_rows, Scalar* work) const {
#pragma omp for schedule(static)
  for (Index begin = 0; begin < num_rows; begin += kRowBlock) {
    kernel_.multiply(entries, target_lists, source_lists, factor, source, adds, target, begin,
                     std::min(num_rows, begin + kRowBlock), work_size_, work);
  }
}

// Restricts to the next level. After relaxation, the residual of a row comes from later rows, up to
// a part that the projection removes.
template <class Scalar, int Dim>
void ActiveMultigrid<Scalar, Dim>::descend(std::size_t l, const Scalar* right_side, Scalar* work) {
  LevelData& level = levels_[l];
  const auto fine = view(l, right_side);
  for (std::size_t colour = 0; colour + 1 < level.order.colour_starts.size(); ++colour) {
    for_blocks(level.order, colour, [&](Index begin, Index end) {
      kernel_.descend(fine, begin, end, work_size_, work);
    });
  }
  if (l + 1 == levels_.size()) return;
  LevelData& coarse = levels_[l + 1];
  multiply(fine.upper, fine.lists, fine.lists, -1, fine.solution, false, level.rest.data(),
           level.num_rows(), work);
  multiply(all_of(level.restriction), coarse.own_lists.view(), fine.lists, 1, level.rest.data(),
           false, coarse.right_side.data(), coarse.num_rows(), work);
}

template <class Scalar, int Dim>
void ActiveMultigrid<Scalar, Dim>::ascend(std::size_t l, const Scalar* right_side, Scalar* work) {
  LevelData& level = levels_[l];
  const auto fine = view(l, right_side);
  if (l + 1 < levels_.size()) {
    const LevelData& coarse = levels_[l + 1];
    multiply(all_of(level.prolongation), fine.lists, coarse.own_lists.view(), 1,
             coarse.solution.data(), true, fine.solution, level.num_rows(), work);
  }
  for (std::size_t colour = level.order.colour_starts.size() - 1; colour-- > 0;) {
    for_blocks(level.order, colour,
               [&](Index begin, Index end) { kernel_.ascend(fine, begin, end, work_size_, work); });
  }
}

template <class Scalar, int Dim>
void ActiveMultigrid<Scalar, Dim>::cycle(Scalar* rows) {
  // The threads wait for each other, so none of them may throw.
  AlignedArray<Scalar> works(2 * work_size_ * static_cast<std::size_t>(omp_get_max_threads()));
#pragma omp parallel num_threads(team_size())
  {
    const FlushDenormals flush;
    Scalar* const work = works.data() + 2 * work_size_ * omp_get_thread_num();
    for (std::size_t l = 0; l < levels_.size(); ++l) descend(l, rows, work);
    for (std::size_t l = levels_.size(); l-- > 0;) ascend(l, rows, work);
  }
  const LevelData& finest = levels_.front();
  std::copy_n(finest.solution.data(), lists_.starts[finest.num_rows()], rows);
}

FLBC_INSTANTIATE_SCALAR_CLASS(ActiveMultigrid)

}  // namespace flbc::active_set
