// SPDX-License-Identifier: BSD-3-Clause
// The inner loops of the triangular solves on plain arrays. The same source is compiled for
// several instruction sets; it must not use headers whose inline functions could clash, such as
// Eigen.
#pragma once

#include <cstddef>
#include <cstdint>

#include "base/kernel_dispatch.h"

namespace flbc::panel {

//! Columns in a panel. With this number, the rows of a panel stay in the L1 cache while it is used,
//! and most of a supernode is used once per 16 columns.
constexpr int kMaxWidth = 16;

//! A few neighboring columns of the factor, with diagonal block D and the block B below it. The
//! stored values are D^-1 and -B D^-1. Both substitutions are then products, without divisions or
//! sequential dependencies.
struct Panel {
  std::size_t entries;  //!< start of its values: the lower triangle of D^-1 by rows, then -B D^-1
                        //!< by rows
  std::size_t below;    //!< start of the list of rows of B
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
//! .. end - 1 (multiples of 8) of rows of `stride` values.
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
