// SPDX-License-Identifier: BSD-3-Clause
#include "solver/start/flux_densities.h"

#include <algorithm>

namespace flbc {

template <int Dim>
FluxDensities<Dim>::FluxDensities(Index num_control_points, Index num_cells,
                                  const VectorsAt<Dim>& of_cell)
    : num_control_points_(num_control_points),
      blocks_((num_cells + kBlockCells - 1) / kBlockCells) {
  const auto num_blocks = static_cast<Index>(blocks_.size());
#pragma omp parallel
  {
    Block block;  // grows once, which leaves no holes between those that are kept
#pragma omp for schedule(static)
    for (Index b = 0; b < num_blocks; ++b) {
      fill(b, num_cells, of_cell, block);
      blocks_[b] = block;
    }
  }
}

template <int Dim>
void FluxDensities<Dim>::fill(Index number, Index num_cells, const VectorsAt<Dim>& of_cell,
                              Block& block) const {
  block.starts.assign(1, 0);
  block.control_points.clear();
  block.vectors.clear();
  for (Index s = number * kBlockCells; s < std::min(num_cells, (number + 1) * kBlockCells); ++s) {
    const Eigen::Matrix<double, Eigen::Dynamic, Dim> density = of_cell(s);
    for (Index i = 0; i < num_control_points_; ++i) {
      if ((density.row(i).array() == 0).all()) continue;
      block.control_points.push_back(i);
      for (int d = 0; d < Dim; ++d) block.vectors.push_back(static_cast<float>(density(i, d)));
    }
    block.starts.push_back(static_cast<Index>(block.control_points.size()));
  }
}

template <int Dim>
Eigen::Matrix<double, Eigen::Dynamic, Dim> FluxDensities<Dim>::cell(Index cell) const {
  Eigen::Matrix<double, Eigen::Dynamic, Dim> density =
      Eigen::Matrix<double, Eigen::Dynamic, Dim>::Zero(num_control_points_, Dim);
  const Block& block = blocks_[cell / kBlockCells];
  const Index place = cell % kBlockCells;
  for (Index k = block.starts[place]; k < block.starts[place + 1]; ++k) {
    for (int d = 0; d < Dim; ++d) density(block.control_points[k], d) = block.vectors[k * Dim + d];
  }
  return density;
}

template class FluxDensities<2>;
template class FluxDensities<3>;

}  // namespace flbc
