// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! The updates of the fast marching method within a cell.
#pragma once

#include <cstdint>

namespace flbc::distance {

//! By the set of the cell's corners that have been passed, as bits: looked up rather than computed,
//! because it is asked whenever a vertex is passed in one of its cells.
struct CellTasks {
  static constexpr std::int8_t kAll = 4;
  std::int8_t missing[16];        //!< the only corner that is missing, or kAll if none is
  std::uint8_t is_something[16];  //!< 1 if either is so, otherwise 0, and nothing is to be done
};

template <int Dim>
constexpr CellTasks cell_tasks() {
  CellTasks tasks{};
  constexpr unsigned kFull = (1u << (Dim + 1)) - 1;
  tasks.missing[kFull] = CellTasks::kAll;
  tasks.is_something[kFull] = 1;
  for (int k = 0; k <= Dim; ++k) {
    tasks.missing[kFull - (1u << k)] = static_cast<std::int8_t>(k);
    tasks.is_something[kFull - (1u << k)] = 1;
  }
  return tasks;
}

}  // namespace flbc::distance
