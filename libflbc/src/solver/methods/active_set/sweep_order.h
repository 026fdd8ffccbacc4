// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! An order of unknowns in which several threads can sweep at once.
#pragma once

#include <vector>

#include "linear/aggregation.h"

namespace flbc::active_set {

//! Blocks of unknowns in an order in which those of one colour do not touch: each may be swept by a
//! thread of its own, with the same result whoever does it.
struct SweepOrder {
  std::vector<Index> position;       //!< of every unknown
  std::vector<Index> block_starts;   //!< positions, blocks + 1
  std::vector<Index> colour_starts;  //!< blocks, colours + 1
};

//! Unknowns that follow each other stay together. \param matrix  symmetric
SweepOrder sweep_order(const RowMatrix& matrix);

}  // namespace flbc::active_set
