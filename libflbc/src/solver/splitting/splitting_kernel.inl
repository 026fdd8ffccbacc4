// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! The loops, included once per instruction set with FLBC_ISA as its name. Each including file is
//! compiled with the flags of that set (see libflbc/CMakeLists.txt).
#include <limits>

#include "base/simd.h"
#include "solver/splitting/splitting_kernel.h"

namespace flbc::splitting::FLBC_ISA {
namespace {

// Elements between two transfers of the measured violation into double precision.
constexpr std::size_t kBlock = 64;

#include "solver/splitting/splitting_steps.inl"

// Single precision sums of many elements lose digits: pass them on after each block.
template <class Scalar, int Dim>
inline void collect_violation(const Arrays<Scalar, Dim>& arrays, Columns columns) {
  for (std::size_t i = columns.begin; i < columns.end; ++i) {
    arrays.violation[i] += static_cast<double>(arrays.violation_sum[i]);
    arrays.violation_sum[i] = 0;
  }
}

template <class Scalar, int Dim>
void clear_residual(const Arrays<Scalar, Dim>& arrays, Columns columns) {
  for (std::size_t row = 0; row <= arrays.num_interior; ++row) {
    for (std::size_t i = columns.begin; i < columns.end; i += kRowLanes) {
      store_pack<kRowLanes>(arrays.residual + row * arrays.stride + i, PackN<Scalar, kRowLanes>{});
    }
  }
}

template <class Scalar, int Dim, bool Measured>
void w_step(const Arrays<Scalar, Dim>& arrays, Columns columns) {
  if (arrays.vertex_state == nullptr) {
    clear_residual(arrays, columns);
    return;
  }
  for (std::size_t row = 0; row < arrays.num_interior; ++row) {
    std::size_t i = columns.begin;
    for (; i + 16 <= columns.end; i += 16) {
      w_step_at<Scalar, Dim, Measured, 16>(arrays, row, i);
    }
    if (i < columns.end) w_step_at<Scalar, Dim, Measured, 8>(arrays, row, i);
    if constexpr (Measured) {
      if (row % kBlock == 0) collect_violation(arrays, columns);
    }
  }
  if constexpr (Measured) collect_violation(arrays, columns);
}

template <class Scalar, int Dim, bool Measured>
void z_step(const Arrays<Scalar, Dim>& arrays, Columns columns) {
  for (std::size_t s = 0; s < arrays.num_cells; ++s) {
    const auto cell = gather_cell(arrays, s);
    std::size_t i = columns.begin;
    for (; i + 16 <= columns.end; i += 16) {
      z_step_at<Scalar, Dim, Measured, 16>(arrays, cell, i);
    }
    if (i < columns.end) z_step_at<Scalar, Dim, Measured, 8>(arrays, cell, i);
    if constexpr (Measured) {
      if (s % kBlock == 0) collect_violation(arrays, columns);
    }
  }
  if constexpr (Measured) collect_violation(arrays, columns);
}

template <class Scalar, int Dim>
double y_step(const Arrays<Scalar, Dim>& arrays, std::int32_t begin, std::int32_t end) {
  double change = 0;
  for (std::int32_t row = begin; row < end; ++row) change += y_step_at(arrays, std::size_t(row));
  return change;
}

template <class Scalar, int Dim>
void flux(const Arrays<Scalar, Dim>& arrays, Columns columns, const Scalar* scale, Scalar* flux) {
  for (std::size_t s = 0; s < arrays.num_cells; ++s) {
    const auto cell = gather_cell(arrays, s);
    for (std::size_t i = columns.begin; i < columns.end; i += kRowLanes) {
      PackN<Scalar, kRowLanes> x[Dim];
      PackN<Scalar, kRowLanes> y[Dim];
      PackN<Scalar, kRowLanes> p[Dim];
      weight_gradient<Scalar, Dim, kRowLanes>(cell, i, x);
      for (int d = 0; d < Dim; ++d) {
        y[d] = load_pack<kRowLanes>(cell.state + d * arrays.cell_stride + i);
      }
      clip<Scalar, Dim, kRowLanes>(cell, i, x, y, p);
      for (int d = 0; d < Dim; ++d) {
        store_pack<kRowLanes>(flux + (s * Dim + d) * arrays.stride + i, scale[s] * p[d]);
      }
    }
  }
}

template <class Scalar, int Dim>
constexpr Kernel<Scalar, Dim> kKernel{w_step<Scalar, Dim, false>, z_step<Scalar, Dim, false>,
                                      w_step<Scalar, Dim, true>,  z_step<Scalar, Dim, true>,
                                      y_step<Scalar, Dim>,        flux<Scalar, Dim>};

}  // namespace
}  // namespace flbc::splitting::FLBC_ISA

namespace flbc {
FLBC_DEFINE_KERNEL(splitting, float, 2)
FLBC_DEFINE_KERNEL(splitting, float, 3)
FLBC_DEFINE_KERNEL(splitting, double, 2)
FLBC_DEFINE_KERNEL(splitting, double, 3)
}  // namespace flbc
