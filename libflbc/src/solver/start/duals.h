// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Weights and duals that outlive their iteration, in a form that other meshes understand.
#pragma once

#include <vector>

#include "flbc/sparse_weights.h"
#include "solver/start/start.h"

namespace flbc {

//! p_s / A_s of every cell, for the control points where it is not zero: nothing else takes memory.
//! In single precision: its rounding is far below what a start is off by.
template <int Dim>
class FluxDensities {
 public:
  //! None.
  FluxDensities() = default;

  //! \param num_control_points  n \param num_cells  F
  //! \param of_cell  n x Dim; is asked by several threads
  FluxDensities(Index num_control_points, Index num_cells, const VectorsAt<Dim>& of_cell);

  //! In one cell, n x Dim.
  Vectors<Dim> cell(Index cell) const;

 private:
  // The control points and vectors of some cells, one after the other.
  struct Block {
    std::vector<Index> starts;
    std::vector<Index> control_points;
    std::vector<float> vectors;
  };
  static constexpr Index kBlockCells = 64;

  Index num_control_points_ = 0;
  std::vector<Block> blocks_;
};

//! The state of an iteration as quantities that have a limit as meshes become finer: densities, not
//! numbers per cell. Lengths are those of the problem. n control points, V vertices, F cells.
template <int Dim>
struct Duals {
  double penalty = 0;                 //!< used last
  SparseWeights weights{};            //!< of V points
  FluxDensities<Dim> flux_density{};  //!< p_s / A_s, at most phi long
  //! q - w of the constraint u = w, u >= 0, without its zeros, of V points; for the penalty above.
  //! No points without the constraint.
  SparseWeights vertex_dual{};
};

//! Copies what a start refers to.
template <int Dim>
Duals<Dim> keep(const LbcProblem<Dim>& problem, const Start<Dim>& start);

}  // namespace flbc
