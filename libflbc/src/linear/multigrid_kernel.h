// SPDX-License-Identifier: BSD-3-Clause
// The inner loops of the multigrid cycle on plain arrays. The same source is compiled for several
// instruction sets; it does not use Eigen, whose inline functions could clash.
#pragma once

#include <cstddef>
#include <cstdint>

#include "base/kernel_dispatch.h"

namespace flbc::multigrid {

//! A sparse matrix by rows, columns ascending.
template <class Scalar>
struct Rows {
  const std::int32_t* starts;
  const std::int32_t* columns;
  const Scalar* values;
};

//! One level: its matrix A = L + D + L^T and the prolongation P from the next coarser level.
template <class Scalar>
struct Level {
  std::int32_t size;
  std::int32_t coarse_size;
  Rows<Scalar> off_diagonal;       // L + L^T
  const std::int32_t* upper;       // start of the entries right of the diagonal in each row
  const Scalar* inverse_diagonal;  // D^-1
  Rows<Scalar> prolongation;       // size x coarse_size
};

//! Arrays of rows of `stride` values; the loops process columns begin .. end - 1, multiples of 8.
template <class Scalar>
struct Vectors {
  Scalar* right_side;
  Scalar* solution;
  Scalar* coarse;  // right-hand side of the coarser level; its solution on the way up
  std::size_t stride, begin, end;
};

//! The loops for one instruction set.
template <class Scalar>
struct Kernel {
  using Sweep = void (*)(const Level<Scalar>&, const Vectors<Scalar>&);
  //! solution = (L + D)^-1 right_side, coarse = P^T (right_side - A solution).
  Sweep descend;
  //! solution += P coarse, then a Gauss-Seidel sweep in the opposite order. The solution also
  //! overwrites right_side.
  Sweep ascend;
};

}  // namespace flbc::multigrid

namespace flbc {
FLBC_DECLARE_KERNEL(multigrid, float)
FLBC_DECLARE_KERNEL(multigrid, double)
}  // namespace flbc
