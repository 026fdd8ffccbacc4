// SPDX-License-Identifier: BSD-3-Clause
// The loops, included once per instruction set with FLBC_ISA as its name. Each including file is
// compiled with the flags of that set (see libflbc/CMakeLists.txt).
#include "linear/multigrid_kernel.h"

#include <type_traits>

#include "base/simd.h"

namespace flbc::multigrid::FLBC_ISA {
namespace {

// sum - A(row, entries begin .. end - 1) x.
template <int Lanes, class Scalar>
inline PackN<Scalar, Lanes> subtract_row(const Rows<Scalar>& rows, std::int32_t begin,
                                         std::int32_t end, const Scalar* x, std::size_t stride,
                                         PackN<Scalar, Lanes> sum) {
  for (std::int32_t k = begin; k < end; ++k) {
    sum -= rows.values[k] * load_pack<Lanes>(x + std::size_t(rows.columns[k]) * stride);
  }
  return sum;
}

// Calls a step for the columns of a slice, in packs that fit the registers.
template <class Scalar, class Step>
inline void for_packs(const Vectors<Scalar>& vectors, Step step) {
  std::size_t i = vectors.begin;
  for (; i + 16 <= vectors.end; i += 16) step(std::integral_constant<int, 16>(), i);
  if (i < vectors.end) step(std::integral_constant<int, 8>(), i);
}

template <class Scalar>
void clear_coarse(const Level<Scalar>& level, const Vectors<Scalar>& vectors) {
  for (std::int32_t row = 0; row < level.coarse_size; ++row) {
    Scalar* coarse = vectors.coarse + std::size_t(row) * vectors.stride;
    for_packs(vectors, [&](auto lanes, std::size_t i) {
      store_pack<lanes()>(coarse + i, PackN<Scalar, lanes()>{});
    });
  }
}

// A Gauss-Seidel sweep from zero; entries right of the diagonal do not contribute yet.
template <class Scalar>
void smooth_forward(const Level<Scalar>& level, const Vectors<Scalar>& vectors) {
  const Rows<Scalar>& rows = level.off_diagonal;
  for (std::int32_t row = 0; row < level.size; ++row) {
    const std::size_t place = std::size_t(row) * vectors.stride;
    for_packs(vectors, [&](auto lanes, std::size_t i) {
      const auto sum =
          subtract_row<lanes()>(rows, rows.starts[row], level.upper[row], vectors.solution + i,
                                vectors.stride, load_pack<lanes()>(vectors.right_side + place + i));
      store_pack<lanes()>(vectors.solution + place + i, level.inverse_diagonal[row] * sum);
    });
  }
}

// After that sweep, the residual consists of the entries right of the diagonal.
template <class Scalar>
void restrict_residual(const Level<Scalar>& level, const Vectors<Scalar>& vectors) {
  const Rows<Scalar>& rows = level.off_diagonal;
  const Rows<Scalar>& prolongation = level.prolongation;
  for (std::int32_t row = 0; row < level.size; ++row) {
    for_packs(vectors, [&](auto lanes, std::size_t i) {
      const auto residual =
          subtract_row<lanes()>(rows, level.upper[row], rows.starts[row + 1], vectors.solution + i,
                                vectors.stride, PackN<Scalar, lanes()>{});
      for (std::int32_t k = prolongation.starts[row]; k < prolongation.starts[row + 1]; ++k) {
        Scalar* coarse = vectors.coarse + std::size_t(prolongation.columns[k]) * vectors.stride + i;
        store_pack<lanes()>(coarse, load_pack<lanes()>(coarse) + prolongation.values[k] * residual);
      }
    });
  }
}

template <class Scalar>
void descend(const Level<Scalar>& level, const Vectors<Scalar>& vectors) {
  smooth_forward(level, vectors);
  clear_coarse(level, vectors);
  restrict_residual(level, vectors);
}

template <class Scalar>
void prolong(const Level<Scalar>& level, const Vectors<Scalar>& vectors) {
  const Rows<Scalar>& rows = level.prolongation;
  for (std::int32_t row = 0; row < level.size; ++row) {
    Scalar* solution = vectors.solution + std::size_t(row) * vectors.stride;
    for_packs(vectors, [&](auto lanes, std::size_t i) {
      const auto correction =
          subtract_row<lanes()>(rows, rows.starts[row], rows.starts[row + 1], vectors.coarse + i,
                                vectors.stride, PackN<Scalar, lanes()>{});
      store_pack<lanes()>(solution + i, load_pack<lanes()>(solution + i) - correction);
    });
  }
}

template <class Scalar>
void smooth_backward(const Level<Scalar>& level, const Vectors<Scalar>& vectors) {
  const Rows<Scalar>& rows = level.off_diagonal;
  for (std::int32_t row = level.size; row-- > 0;) {
    const std::size_t place = std::size_t(row) * vectors.stride;
    for_packs(vectors, [&](auto lanes, std::size_t i) {
      const auto sum =
          subtract_row<lanes()>(rows, rows.starts[row], rows.starts[row + 1], vectors.solution + i,
                                vectors.stride, load_pack<lanes()>(vectors.right_side + place + i));
      const PackN<Scalar, lanes()> value = level.inverse_diagonal[row] * sum;
      store_pack<lanes()>(vectors.solution + place + i, value);
      store_pack<lanes()>(vectors.right_side + place + i, value);
    });
  }
}

template <class Scalar>
void ascend(const Level<Scalar>& level, const Vectors<Scalar>& vectors) {
  prolong(level, vectors);
  smooth_backward(level, vectors);
}

template <class Scalar>
constexpr Kernel<Scalar> kKernel{descend<Scalar>, ascend<Scalar>};

}  // namespace
}  // namespace flbc::multigrid::FLBC_ISA

namespace flbc {
FLBC_DEFINE_KERNEL(multigrid, float)
FLBC_DEFINE_KERNEL(multigrid, double)
}  // namespace flbc
