// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! The inner loops of the iteration on the active set (active_splitting.h) on plain arrays. The
//! same source is compiled for several instruction sets; it does not use Eigen, whose inline
//! functions could clash.
//!
//! A row has one value for each control point of its list; rows are ranges of one array.
#pragma once

#include <cstddef>
#include <cstdint>

#include "base/kernel_dispatch.h"

namespace flbc::active_set {

//! The control points of every row, ascending, and the location of its values.
struct Lists {
  const std::size_t* starts;   // rows + 1, multiples of 8
  const std::int32_t* counts;  // of each row; the rest up to the next row is padding, always zero
  const std::uint16_t* items;  // control points; n in the padding
};

//! A sparse matrix by rows, columns ascending; may describe a part of each row.
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

//! The loops for one instruction set. A workspace, if needed, has n + 8 values.
template <class Scalar, int Dim>
struct Kernel {
  //! Forward sweep from zero: computes the optimal change of each row, with zero sum and zero
  //! reproduction, given the previous rows.
  void (*descend)(const Level<Scalar>&, std::int32_t begin, std::int32_t end, std::size_t size,
                  Scalar* work);
  //! Backward sweep from the last row to the first, which updates the current solution in place.
  void (*ascend)(const Level<Scalar>&, std::int32_t begin, std::int32_t end, std::size_t size,
                 Scalar* work);
  //! target = (or +=) factor * matrix * source, on the common control points.
  void (*multiply)(const Entries<Scalar>&, const Lists& target_lists, const Lists& source_lists,
                   Scalar factor, const Scalar* source, bool adds, Scalar* target,
                   std::int32_t begin, std::int32_t end, std::size_t size, Scalar* work);
  //! Copies rows into a block of dense rows. \param slot_of  slot of every control point in these
  void (*gather)(const Lists&, const std::int32_t* rows, std::int32_t count,
                 const std::uint16_t* slot_of, const Scalar* numbers, std::size_t stride,
                 Scalar* block);
  //! Copies back: row k to position starts[k].
  void (*scatter)(const Lists&, const std::int32_t* rows, std::int32_t count,
                  const std::uint16_t* slot_of, const Scalar* block, std::size_t stride,
                  const std::size_t* starts, Scalar* numbers);
};

}  // namespace flbc::active_set

namespace flbc {
FLBC_DECLARE_KERNELS(active_set)
}  // namespace flbc
