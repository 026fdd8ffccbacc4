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

//! For every point, the first point with the same position, weights, and masks. Duplicated vertices
//! (for example at texture seams) must not separate.
template <int Dim>
std::vector<Index> find_representatives(const PointList<Dim>& points, const SparseWeights& weights,
                                        const PointMasks& masks);

//! The edges between representatives, each of which has the weights of all of its duplicates.
//! \param number_of  of the representative of each point; the result uses these numbers
EdgeList welded_edges(const EdgeList& edges, const std::vector<Index>& number_of);

class EdgeGraph {
 public:
  struct Neighbour {
    Index point;
    double weight;
  };

  //! \param points  Dim x P \param edges  validated
  template <int Dim>
  EdgeGraph(const PointList<Dim>& points, const EdgeList& edges);

  VertexItems<Neighbour>::Range neighbours_of(Index point) const { return neighbours_.of(point); }

  //! The sum of k_e |edge|^2 / 2 over the edges of a point, its share of area or volume.
  double mass(Index point) const { return masses_[point]; }

  //! Consecutive points with neighbors. If close points have close numbers, a pass through
  //! a block finds most of what it needs in the cache.
  using Block = std::vector<Index>;

  //! The blocks by color. No two blocks of a color contain neighbors.
  const std::vector<std::vector<Block>>& colors() const { return colors_; }

 private:
  std::vector<Block> make_blocks() const;
  void color(const std::vector<Block>& blocks);

  VertexItems<Neighbour> neighbours_;
  std::vector<double> masses_;
  std::vector<std::vector<Block>> colors_;
};

}  // namespace flbc
