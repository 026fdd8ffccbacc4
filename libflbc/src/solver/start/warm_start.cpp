// SPDX-License-Identifier: BSD-3-Clause
#include "solver/start/warm_start.h"

#include <algorithm>

#include "base/instantiate.h"
#include "base/parallel.h"

namespace flbc {

template <int Dim>
FluxDensities<Dim>::FluxDensities(Index num_control_points, Index num_cells,
                                  const VectorsAt<Dim>& of_cell)
    : num_control_points_(num_control_points),
      blocks_((num_cells + kBlockCells - 1) / kBlockCells) {
  const auto store = [&](Index begin, Index end) {
    Block block;  // grows once, which avoids fragmentation
    for (Index b = begin; b < end; ++b) {
      const Index first = b * kBlockCells;
      block.starts.assign(1, 0);
      block.control_points.clear();
      block.vectors.clear();
      for (Index s = first; s < std::min(num_cells, first + kBlockCells); ++s) {
        const Vectors<Dim> density = of_cell(s);
        for (Index i = 0; i < num_control_points; ++i) {
          if ((density.row(i).array() == 0).all()) continue;
          block.control_points.push_back(i);
          for (const double number : density.row(i)) {
            block.vectors.push_back(static_cast<float>(number));
          }
        }
        block.starts.push_back(static_cast<Index>(block.control_points.size()));
      }
      blocks_[b] = block;
    }
  };
  parallel_for(static_cast<Index>(blocks_.size()), store, kFewestInParallel / kBlockCells);
}

template <int Dim>
Vectors<Dim> FluxDensities<Dim>::cell(Index cell) const {
  Vectors<Dim> density = Vectors<Dim>::Zero(num_control_points_, Dim);
  const Block& block = blocks_[cell / kBlockCells];
  const Index place = cell % kBlockCells;
  for (Index k = block.starts[place]; k < block.starts[place + 1]; ++k) {
    for (int d = 0; d < Dim; ++d) density(block.control_points[k], d) = block.vectors[k * Dim + d];
  }
  return density;
}

template <int Dim>
WarmStart<Dim> keep(const LbcProblem<Dim>& problem, const Start<Dim>& start) {
  const Index n = problem.num_control_points();
  const Index num_vertices = problem.mesh.num_vertices();
  WarmStart<Dim> warm_start;
  warm_start.flux_density = {n, problem.mesh.num_cells(), start.flux_density};
  warm_start.penalty = start.penalty;
  warm_start.weights =
      SparseWeights::of(n, num_vertices, with_known_values(problem, start.weights));
  if (!start.vertex_dual) return warm_start;
  const Eigen::VectorXd none = Eigen::VectorXd::Zero(n);
  warm_start.vertex_dual = SparseWeights::of(n, num_vertices, [&](Index v) {
    return problem.boundary.is_interior(v) ? start.vertex_dual(v) : none;
  });
  return warm_start;
}

template class FluxDensities<2>;
template class FluxDensities<3>;
FLBC_INSTANTIATE_FUNCTION(keep)

}  // namespace flbc
