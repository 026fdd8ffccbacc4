// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Stored weights and duals of an iteration, in a form that applies to other meshes.
#pragma once

#include <vector>

#include "flbc/sparse_weights.h"
#include "solver/start/start.h"

namespace flbc {

//! The nonzero p_s / A_s of every cell. Single precision, because its rounding is far below the
//! error of a start.
template <int Dim>
class FluxDensities {
 public:
  //! Empty.
  FluxDensities() = default;

  //! \param num_control_points  n \param num_cells  F
  //! \param of_cell  n x Dim; called by several threads
  FluxDensities(Index num_control_points, Index num_cells, const VectorsAt<Dim>& of_cell);

  //! The vectors of one cell, n x Dim.
  Vectors<Dim> cell(Index cell) const;

 private:
  // The control points and vectors of some cells, concatenated.
  struct Block {
    std::vector<Index> starts;
    std::vector<Index> control_points;
    std::vector<float> vectors;
  };
  static constexpr Index kBlockCells = 64;

  Index num_control_points_ = 0;
  std::vector<Block> blocks_;
};

//! The state of an iteration as quantities with a limit under mesh refinement: densities instead of
//! values per cell. Lengths are in problem units. n control points, V vertices, F cells.
template <int Dim>
struct WarmStart {
  double penalty = 0;                 //!< last penalty
  SparseWeights weights{};            //!< of V points
  FluxDensities<Dim> flux_density{};  //!< p_s / A_s, admissible
  //! Sparse q - w of the constraint u = w, u >= 0, at V points, for the penalty above. Empty
  //! without the constraint.
  SparseWeights vertex_dual{};
};

//! Copies the data of a start.
template <int Dim>
WarmStart<Dim> keep(const LbcProblem<Dim>& problem, const Start<Dim>& start);

}  // namespace flbc
