// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! The inner loops of the iteration on the active set (active_splitting.h) on plain arrays. The
//! same source is compiled for several instruction sets; there is no Eigen here, whose inline
//! functions could clash.
//!
//! A row has a number for each control point of its list, in a place of its own in one array.
#pragma once

#include <cstddef>
#include <cstdint>

#include "base/kernel_dispatch.h"

namespace flbc::active_set {

//! The control points of every row, ascending, and where the row's numbers stand.
struct Lists {
  const std::size_t* starts;   // rows + 1, multiples of 8
  const std::int32_t* counts;  // of each row; the rest up to the next one is padding, always zero
  const std::uint16_t* items;  // control points; those of the padding are the number of them
};

//! A sparse matrix by rows, columns ascending, of which a part of each row may be asked for.
template <class Scalar>
struct Entries {
  const std::int32_t* begins;
  const std::int32_t* ends;
  const std::int32_t* columns;
  const Scalar* values;
};

//! The system on one level and the constraints of its rows.
template <class Scalar>
struct Level {
  Lists lists;
  Entries<Scalar> lower, upper;    // of the matrix
  const Scalar* inverse_diagonal;  // of the matrix
  const Scalar* basis;             // of [1; c] on the list, Dim + 1 orthonormal rows at a time
  const Scalar* right_side;
  Scalar* solution;
};

//! The loops for one instruction set. Those that need it take a workspace of as many numbers as
//! there are control points, and 8 more.
template <class Scalar, int Dim>
struct Kernel {
  //! One row after the other from zero: the best change of this row, whose sum is zero and which
  //! reproduces zero, while the rows before it are as they are.
  void (*descend)(const Level<Scalar>&, std::int32_t begin, std::int32_t end, std::size_t size,
                  Scalar* work);
  //! The same from the last row to the first, in place of the solution there is.
  void (*ascend)(const Level<Scalar>&, std::int32_t begin, std::int32_t end, std::size_t size,
                 Scalar* work);
  //! target = factor times the matrix times source, or added to it; on the control points both
  //! have.
  void (*multiply)(const Entries<Scalar>&, const Lists& target_lists, const Lists& source_lists,
                   Scalar factor, const Scalar* source, bool adds, Scalar* target,
                   std::int32_t begin, std::int32_t end, std::size_t size, Scalar* work);
  //! Rows into a block of dense rows. \param slot_of  place of every control point in these
  void (*gather)(const Lists&, const std::int32_t* rows, std::int32_t count,
                 const std::uint16_t* slot_of, const Scalar* numbers, std::size_t stride,
                 Scalar* block);
  //! Back again: row k to place starts[k].
  void (*scatter)(const Lists&, const std::int32_t* rows, std::int32_t count,
                  const std::uint16_t* slot_of, const Scalar* block, std::size_t stride,
                  const std::size_t* starts, Scalar* numbers);
};

}  // namespace flbc::active_set

namespace flbc {
FLBC_DECLARE_KERNELS(active_set)
}  // namespace flbc
