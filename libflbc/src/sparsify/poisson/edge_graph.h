// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Points and their neighbours, ready for passes over them that are parallel and yet give the same
//! result for any number of threads.
#pragma once

#include <vector>

#include "flbc/domain_mesh.h"
#include "mesh/vertex_cells.h"

namespace flbc {

//! Points that coincide and have the same weights are one point here, with all their edges: where a
//! file has a vertex twice, as at the borders of texture charts, nothing must tear.
class EdgeGraph {
 public:
  struct Neighbour {
    Index point;
    double weight;
  };

  //! \param points  Dim x P \param weights  n x P \param edges  validated
  template <int Dim>
  EdgeGraph(const PointList<Dim>& points, const WeightMatrix& weights, const EdgeList& edges);

  //! The first of the points that are one with this one.
  Index representative(Index point) const { return representatives_[point]; }

  //! Of a representative; others have none.
  VertexItems<Neighbour>::Range neighbours_of(Index point) const { return neighbours_.of(point); }

  //! The sum of k_e |edge|^2 / 2 over the edges of a point: its share of area or volume.
  double mass(Index point) const { return masses_[point]; }

  //! The representatives that have neighbours, in groups without neighbours inside.
  const std::vector<std::vector<Index>>& colors() const { return colors_; }

 private:
  void color();

  std::vector<Index> representatives_;
  VertexItems<Neighbour> neighbours_;
  std::vector<double> masses_;
  std::vector<std::vector<Index>> colors_;
};

}  // namespace flbc
