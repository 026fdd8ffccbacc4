// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! The loops, included once per instruction set with FLBC_ISA as its name. Each including file is
//! compiled with the flags of that set (see cmake/kernels.cmake).
#include <limits>
#include <type_traits>

#include "base/simd.h"
#include "solver/methods/splitting/compact_kernel.h"

namespace flbc::compact::FLBC_ISA {
namespace {

#include "solver/methods/splitting/stored_pack.inl"
// after what it uses
#include "solver/methods/splitting/compact_steps.inl"

// Cells between two transfers of the measured violation into double precision.
constexpr std::size_t kCollected = 64;

template <class Scalar, int Dim>
inline int num_interior_corners(const Cell<Scalar, Dim>& cell, std::size_t num_interior) {
  int count = 1;
  while (count <= Dim && std::size_t(cell.rows[count]) < num_interior) ++count;
  return count;
}

// Calls `body(corners, cell)` for all cells. Loops over interior corners then have the compile-time
// bound corners().
template <class Scalar, int Dim, class Body>
[[gnu::always_inline]] inline void for_cells(const Arrays<Scalar, Dim>& arrays, const Body& body) {
  for (std::size_t s = 0; s < arrays.num_cells; ++s) {
    switch (num_interior_corners(arrays.cells[s], arrays.num_interior)) {
      case 1:
        body(std::integral_constant<int, 1>{}, s);
        break;
      case 2:
        body(std::integral_constant<int, 2>{}, s);
        break;
      case 3:
        body(std::integral_constant<int, 3>{}, s);
        break;
      default:
        body(std::integral_constant<int, Dim + 1>{}, s);
    }
  }
}

// Single precision sums of many elements lose digits, so each block is added in double precision.
template <class Scalar, int Dim>
inline void collect_violation(const Arrays<Scalar, Dim>& arrays, Columns columns) {
  for (std::size_t i = columns.begin; i < columns.end; ++i) {
    arrays.violation[i] += static_cast<double>(arrays.violation_sum[i]);
    arrays.violation_sum[i] = 0;
  }
}

template <class Scalar, class Stored, int Dim, bool Measured>
void z_step(const Arrays<Scalar, Dim>& arrays, Columns columns) {
  for_cells(
      arrays, [&](auto corners, std::size_t s) __attribute__((always_inline)) {
        for_packs<kWideLanes>(
            columns.begin,
            columns.end, [&](auto lanes, std::size_t i) __attribute__((always_inline)) {
              z_step_at<Scalar, Stored, Dim, corners(), Measured, lanes()>(arrays, s, i);
            });
        if constexpr (Measured) {
          if (s % kCollected == 0) collect_violation(arrays, columns);
        }
      });
  if constexpr (Measured) collect_violation(arrays, columns);
}

template <class Scalar, int Dim>
void harmonic_residual(const Arrays<Scalar, Dim>& arrays, Columns columns) {
  for_cells(
      arrays, [&](auto corners, std::size_t s) __attribute__((always_inline)) {
        for_packs<kWideLanes>(
            columns.begin,
            columns.end, [&](auto lanes, std::size_t i) __attribute__((always_inline)) {
              harmonic_residual_at<Scalar, Dim, corners(), lanes()>(arrays, s, i);
            });
      });
}

// Sums the results of a step for the rows begin .. end - 1.
template <class Step>
inline RowSums over_rows(std::int32_t begin, std::int32_t end, const Step& step) {
  RowSums sums;
  for (std::int32_t row = begin; row < end; ++row) {
    const RowSums part = step(std::size_t(row));
    sums.change += part.change;
    sums.violation += part.violation;
  }
  return sums;
}

template <class Scalar, int Dim, bool Measured>
RowSums y_step(const Arrays<Scalar, Dim>& arrays, std::int32_t begin, std::int32_t end) {
  return over_rows(begin, end,
                   [&](std::size_t row) { return y_step_at<Scalar, Dim, Measured>(arrays, row); });
}

template <class Scalar, int Dim>
RowSums correct(const Arrays<Scalar, Dim>& arrays, std::int32_t begin, std::int32_t end) {
  return over_rows(begin, end, [&](std::size_t row) { return correct_at(arrays, row); });
}

template <class Scalar, int Dim>
RowSums w_step(const Arrays<Scalar, Dim>& arrays, std::int32_t begin, std::int32_t end) {
  return over_rows(begin, end, [&](std::size_t row) {
    LaneSum<Scalar> none;
    const Scalar* a = arrays.extrapolated + row * arrays.stride;
    for_packs<kWideLanes>(
        0, arrays.stride, [&](auto lanes, std::size_t i) __attribute__((always_inline)) {
          w_step_at<Scalar, Dim, false, lanes()>(arrays, row, i, load_pack<lanes()>(a + i),
                                                 PackN<Scalar, lanes()>{}, none);
        });
    return RowSums{};
  });
}

// Calls `body(cell, column)` for all cells and packs of 8 columns.
template <class Scalar, int Dim, class Body>
inline void for_numbers(const Arrays<Scalar, Dim>& arrays, Columns columns, const Body& body) {
  for (std::size_t s = 0; s < arrays.num_cells; ++s) {
    for (std::size_t i = columns.begin; i < columns.end; i += 8) body(s, i);
  }
}

template <class Scalar, class Stored, int Dim>
void start_cell_dual(const Arrays<Scalar, Dim>& arrays, Columns columns) {
  for_numbers(arrays, columns, [&](std::size_t s, std::size_t i) {
    Stored* rows = static_cast<Stored*>(arrays.cell_dual) + s * Dim * arrays.cell_stride;
    PackN<Scalar, 8> gradient[Dim] = {};
    add_gradient<Scalar, Dim, 8>(arrays.cells[s], arrays.extrapolated, arrays.stride, i, gradient);
    for (int d = 0; d < Dim; ++d) {
      store_stored<8>(rows + d * arrays.cell_stride + i, saturated<Stored, Scalar, 8>(gradient[d]));
    }
  });
}

template <class Scalar, class Stored, int Dim>
void flux(const Arrays<Scalar, Dim>& arrays, Columns columns, const Scalar* scale, Scalar* flux) {
  for_numbers(arrays, columns, [&](std::size_t s, std::size_t i) {
    const auto cell = std::size_t(arrays.cell_index[s]);
    PackN<Scalar, 8> p[Dim];
    load_cell_dual<Scalar, Stored, Dim, 8>(arrays, s, i, p);
    add_gradient<Scalar, Dim, 8>(arrays.cells[s], arrays.extrapolated, arrays.stride, i, p);
    clip<Scalar, Stored, Dim, 8>(arrays, s, i, p);
    for (int d = 0; d < Dim; ++d) {
      store_pack<8>(flux + (cell * Dim + d) * arrays.stride + i, scale[cell] * p[d]);
    }
  });
}

// The norms for balancing the penalty, see CompactSplitting::squared_lengths.
template <class Scalar, class Stored, int Dim>
void balance(const Arrays<Scalar, Dim>& arrays, Columns columns, const Scalar* moved, double* dual,
             double* motion) {
  using Numbers = PackN<Scalar, 8>;
  for_numbers(arrays, columns, [&](std::size_t s, std::size_t i) {
    Numbers p[Dim];
    Numbers gradient[Dim] = {};
    load_cell_dual<Scalar, Stored, Dim, 8>(arrays, s, i, p);
    add_gradient<Scalar, Dim, 8>(arrays.cells[s], arrays.difference, arrays.stride, i, p);
    add_gradient<Scalar, Dim, 8>(arrays.cells[s], moved, arrays.stride, i, gradient);
    Numbers dual2{};
    Numbers motion2{};
    for (int d = 0; d < Dim; ++d) {
      dual2 += p[d] * p[d];
      motion2 += gradient[d] * gradient[d];
    }
    for (std::size_t l = 0; l < 8; ++l) {
      dual[i + l] += static_cast<double>(dual2[l]);
      motion[i + l] += static_cast<double>(motion2[l]);
    }
  });
}

template <class Scalar, class Stored>
void encode(const Scalar* from, void* to, std::size_t first, std::size_t count) {
  Stored* place = static_cast<Stored*>(to) + first;
  for (std::size_t i = 0; i < count; i += 8) {
    store_stored<8>(place + i, saturated<Stored, Scalar, 8>(load_pack<8>(from + i)));
  }
}

template <class Scalar, class Stored>
void decode(const void* from, std::size_t first, Scalar* to, std::size_t count) {
  const Stored* place = static_cast<const Stored*>(from) + first;
  for (std::size_t i = 0; i < count; i += 8) store_pack<8>(to + i, load_stored<8>(place + i));
}

template <class Scalar, class Stored, int Dim>
constexpr Loops<Scalar, Dim> kLoops{z_step<Scalar, Stored, Dim, false>,
                                    z_step<Scalar, Stored, Dim, true>,
                                    y_step<Scalar, Dim, false>,
                                    y_step<Scalar, Dim, true>,
                                    harmonic_residual<Scalar, Dim>,
                                    correct<Scalar, Dim>,
                                    w_step<Scalar, Dim>,
                                    start_cell_dual<Scalar, Stored, Dim>,
                                    flux<Scalar, Stored, Dim>,
                                    balance<Scalar, Stored, Dim>,
                                    encode<Scalar, Stored>,
                                    decode<Scalar, Stored>,
                                    sizeof(Stored)};

template <class Scalar, int Dim>
constexpr Kernel<Scalar, Dim> kKernel{kLoops<Scalar, Scalar, Dim>, {}};
#ifdef __F16C__
using HalfOfFloat = Half;
#else
using HalfOfFloat = float;
#endif
template <int Dim>
constexpr Kernel<float, Dim> kKernel<float, Dim>{kLoops<float, float, Dim>,
                                                 kLoops<float, HalfOfFloat, Dim>};

}  // namespace
}  // namespace flbc::compact::FLBC_ISA

namespace flbc {
FLBC_DEFINE_KERNELS(compact)
}  // namespace flbc
