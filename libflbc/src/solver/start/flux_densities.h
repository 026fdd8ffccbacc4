// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! The flux of every cell, in a form that takes memory only where it is not zero.
#pragma once

#include <vector>

#include "flbc/lbc_problem.h"

namespace flbc {

//! p_s / A_s of every cell, for the control points where it is not zero. In single precision:
//! its rounding is far below what a start is off by.
template <int Dim>
class FluxDensities {
 public:
  //! None.
  FluxDensities() = default;

  //! \param num_control_points  n \param num_cells  F
  //! \param of_cell  n x Dim; is asked by several threads
  FluxDensities(Index num_control_points, Index num_cells, const VectorsAt<Dim>& of_cell);

  //! In one cell, n x Dim.
  Eigen::Matrix<double, Eigen::Dynamic, Dim> cell(Index cell) const;

 private:
  // The control points and vectors of some cells, one after the other.
  struct Block {
    std::vector<Index> starts{0};
    std::vector<Index> control_points;
    std::vector<float> vectors;
  };
  static constexpr Index kBlockCells = 64;

  void fill(Index number, Index num_cells, const VectorsAt<Dim>& of_cell, Block& block) const;

  Index num_control_points_ = 0;
  std::vector<Block> blocks_;
};

}  // namespace flbc
