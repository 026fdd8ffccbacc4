// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! The inner loops of the triangular solves on plain arrays. The same source is compiled for
//! several instruction sets; nothing here may depend on headers whose inline functions could then
//! clash, so there is no Eigen.
#pragma once

#include <cstddef>
#include <cstdint>

#include "base/kernel_dispatch.h"

namespace flbc::panel {

//! Columns in a panel: with so many the rows of a panel stay in the nearest cache while it is used,
//! and most of a supernode is used once per 16 columns.
constexpr int kMaxWidth = 16;

//! A few neighbouring columns of the factor, inverted in themselves: D is their diagonal block and
//! B what is below it, and stored are D^-1 and -B D^-1. Then both substitutions are nothing but
//! products, with no division and no chain of results that wait for each other.
struct Panel {
  std::size_t entries;  //!< where its numbers begin: the lower triangle of D^-1, row by row without
                        //!< what is above the diagonal, then -B D^-1, row by row
  std::size_t below;    //!< where the list of the rows of B begins
  std::int32_t num_below;  //!< number of rows of B
  std::int32_t first;      //!< first column
  std::int32_t width;      //!< 1 .. kMaxWidth columns
};

//! The factor.
template <class Scalar>
struct Panels {
  const Panel* panels;
  std::size_t num_panels;
  const std::int32_t* below;
  const Scalar* entries;
};

//! The loops for one instruction set: solve L Y = B and L^T X = Y in place, for the columns begin
//! .. end - 1 (multiples of 8) of rows of `stride` numbers.
template <class Scalar>
struct Kernel {
  using Sweep = void (*)(const Panels<Scalar>&, Scalar* rows, std::size_t stride, std::size_t begin,
                         std::size_t end);
  Sweep forward;
  Sweep backward;
};

}  // namespace flbc::panel

namespace flbc {
FLBC_DECLARE_KERNEL(panel, float)
FLBC_DECLARE_KERNEL(panel, double)
}  // namespace flbc
