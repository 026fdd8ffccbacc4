// SPDX-License-Identifier: BSD-3-Clause
#include "linear/panel_cholesky.h"

#include <algorithm>

#include <Eigen/Core>

#include "base/parallel.h"
#include "linear/sparse_factor.h"

namespace flbc {
namespace {

constexpr std::size_t kSliceUnit = 16;

// Location of the values of a panel in the factor.
struct PanelSource {
  const Supernode* supernode;
  Index offset;  // of its first column in the supernode
};

// Splits the supernodes into panels of about equal width.
// \param rows  of all supernodes; referenced by the panels
std::vector<PanelSource> split(const SparseFactor& factor, std::vector<panel::Panel>& panels,
                               std::vector<Index>& rows) {
  std::vector<PanelSource> sources;
  std::size_t entries = 0;
  for (const Supernode& supernode : factor.supernodes) {
    const Index count = (supernode.width + panel::kMaxWidth - 1) / panel::kMaxWidth;
    for (Index k = 0; k < count; ++k) {
      const Index begin = k * supernode.width / count;
      const Index end = (k + 1) * supernode.width / count;
      const Index width = end - begin;
      const Index num_below = supernode.num_rows - end;
      panels.push_back({entries, rows.size() + end, num_below, supernode.first + begin, width});
      sources.push_back({&supernode, begin});
      entries += std::size_t(width) * (width + 1) / 2 + std::size_t(width) * num_below;
    }
    rows.insert(rows.end(), supernode.rows, supernode.rows + supernode.num_rows);
  }
  rows.shrink_to_fit();
  return sources;
}

// Stores D^-1 and -B D^-1 instead of D and B, in the order in which the kernel reads them.
template <class Scalar>
void copy_inverted(const PanelSource& source, const panel::Panel& panel, Scalar* entries) {
  using Block = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  const Supernode& supernode = *source.supernode;
  const Eigen::Map<const Eigen::MatrixXd> values(supernode.values, supernode.num_rows,
                                                 supernode.width);
  Block inverse = Block::Identity(panel.width, panel.width);
  values.block(source.offset, source.offset, panel.width, panel.width)
      .triangularView<Eigen::Lower>()
      .solveInPlace(inverse);
  for (Index row = 0; row < panel.width; ++row) {
    for (Index k = 0; k <= row; ++k) *entries++ = static_cast<Scalar>(inverse(row, k));
  }
  Eigen::Map<Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>(
      entries, panel.num_below, panel.width) =
      (-(values.block(source.offset + panel.width, source.offset, panel.num_below, panel.width) *
         inverse))
          .template cast<Scalar>();
}

}  // namespace

Slice slice_of(std::size_t stride, int thread, int num_threads) {
  const std::size_t units = (stride + kSliceUnit - 1) / kSliceUnit;
  return {std::min(stride, units * thread / num_threads * kSliceUnit),
          std::min(stride, units * (thread + 1) / num_threads * kSliceUnit)};
}

template <class Scalar>
PanelCholesky<Scalar>::PanelCholesky(const Eigen::SparseMatrix<double>& matrix,
                                     const panel::Kernel<Scalar>& kernel)
    : kernel_(&kernel) {
  SparseFactor factor = factor_sparse(matrix);
  const auto sources = split(factor, panels_, below_);
  if (!panels_.empty()) {
    const panel::Panel& last = panels_.back();
    entries_ = AlignedArray<Scalar>(last.entries + std::size_t(last.width) * (last.width + 1) / 2 +
                                    std::size_t(last.width) * last.num_below);
  }
  parallel_for_chunks(static_cast<Index>(panels_.size()), 16, [&](Index p) {
    copy_inverted(sources[p], panels_[p], entries_.data() + panels_[p].entries);
  });
  position_ = std::move(factor.position);
}

template <class Scalar>
void PanelCholesky<Scalar>::solve_slice(Scalar* rows, std::size_t stride, std::size_t begin,
                                        std::size_t end) const {
  const panel::Panels<Scalar> panels{panels_.data(), panels_.size(), below_.data(),
                                     entries_.data()};
  kernel_->forward(panels, rows, stride, begin, end);
  kernel_->backward(panels, rows, stride, begin, end);
}

template <class Scalar>
void PanelCholesky<Scalar>::solve(Scalar* rows, std::size_t stride) const {
  in_threads(stride > kSliceUnit, [&](int thread, int num_threads) {
    const Slice slice = slice_of(stride, thread, num_threads);
    if (slice.begin < slice.end) solve_slice(rows, stride, slice.begin, slice.end);
  });
}

template class PanelCholesky<float>;
template class PanelCholesky<double>;

}  // namespace flbc
