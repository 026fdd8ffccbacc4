// SPDX-License-Identifier: BSD-3-Clause
// Length of rows with one value per control point.
#pragma once

#include <cstddef>

namespace flbc {

//! Rows are padded with zeros to a multiple of this, so loops need no remainder.
constexpr std::size_t kRowLanes = 8;

//! \param n  number of values \return length of the padded row
constexpr std::size_t padded(std::size_t n) {
  return (n + kRowLanes - 1) / kRowLanes * kRowLanes;
}

}  // namespace flbc
