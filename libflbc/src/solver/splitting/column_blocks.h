// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Arrays of cells by blocks of control points: threads that work on different blocks then read
//! memory of their own, where rows of all control points would make each of them read every line.
#pragma once

#include <algorithm>
#include <cstddef>

namespace flbc::compact {

//! The order block, cell, component, control point of the block.
struct ColumnBlocks {
  std::size_t stride;  //!< numbers of a row in all blocks
  std::size_t width;   //!< of a block, a multiple of 8; the last one may be narrower

  //! Calls body(begin, width, place) for the columns of every block, and where in the array they
  //! stand. \param row  of so many rows: cell times components, and the component
  template <class Body>
  void for_each(std::size_t row, std::size_t rows, const Body& body) const {
    for (std::size_t begin = 0; begin < stride; begin += width) {
      const std::size_t own_width = std::min(width, stride - begin);
      body(begin, own_width, rows * begin + row * own_width);
    }
  }
};

}  // namespace flbc::compact
