// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! The length of rows that hold a number per control point.
#pragma once

#include <cstddef>

namespace flbc {

//! Rows are padded with zeros to a multiple of this, so that loops over them need no remainder.
constexpr std::size_t kRowLanes = 8;

//! \param n  numbers that count \return length of the row that holds them
constexpr std::size_t padded(std::size_t n) {
  return (n + kRowLanes - 1) / kRowLanes * kRowLanes;
}

}  // namespace flbc
