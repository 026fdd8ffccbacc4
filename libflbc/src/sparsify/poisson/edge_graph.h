// SPDX-License-Identifier: BSD-3-Clause
// Points and their neighbors, in blocks for parallel passes whose results do not depend on the
// number of threads.
#pragma once

#include <vector>

#include "flbc/domain_mesh.h"
#include "flbc/masks.h"
#include "flbc/sparse_weights.h"
#include "mesh/vertex_cells.h"

namespace flbc {

//! Coincident points with equal weights and masks are merged, including their edges, so that
//! duplicated vertices (for example at texture seams) do not separate.
class EdgeGraph {
 public:
  struct Neighbour {
    Index point;
    double weight;
  };

  //! \param points  Dim x P \param weights, masks  of P points \param edges  validated
  template <int Dim>
  EdgeGraph(const PointList<Dim>& points, const SparseWeights& weights, const EdgeList& edges,
            const PointMasks& masks);

  //! The representative of a point: the first of its merged points.
  Index representative(Index point) const { return representatives_[point]; }

  //! The neighbors of a representative; other points have none.
  VertexItems<Neighbour>::Range neighbours_of(Index point) const { return neighbours_.of(point); }

  //! The sum of k_e |edge|^2 / 2 over the edges of a point, its share of area or volume.
  double mass(Index point) const { return masses_[point]; }

  //! Consecutive representatives with neighbors. If close points have close numbers, a pass through
  //! a block finds most of what it needs in the cache.
  using Block = std::vector<Index>;

  //! The blocks by color. No two blocks of a color contain neighbors.
  const std::vector<std::vector<Block>>& colors() const { return colors_; }

 private:
  std::vector<Block> make_blocks() const;
  void color(const std::vector<Block>& blocks);

  std::vector<Index> representatives_;
  VertexItems<Neighbour> neighbours_;
  std::vector<double> masses_;
  std::vector<std::vector<Block>> colors_;
};

}  // namespace flbc
