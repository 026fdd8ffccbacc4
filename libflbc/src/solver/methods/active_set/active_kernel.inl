// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! The loops, included once per instruction set with FLBC_ISA as its name. Each including file is
//! compiled with the flags of that set (see cmake/kernels.cmake).
#include <cstring>

#include "base/simd.h"
#include "solver/methods/active_set/active_kernel.h"

namespace flbc::active_set::FLBC_ISA {
namespace {

// work += row of the matrix times source.
template <class Scalar>
inline void add_products(const Entries<Scalar>& entries, std::int32_t row, const Lists& lists,
                         const Scalar* source, Scalar* work) {
  for (std::int32_t e = entries.begins[row]; e < entries.ends[row]; ++e) {
    const std::int32_t column = entries.columns[e];
    const Scalar value = entries.values[e];
    const std::size_t start = lists.starts[column];
    const std::uint16_t* items = lists.items + start;
    const Scalar* numbers = source + start;
    const std::int32_t count = lists.counts[column];
    // Control points of a list are distinct, which the compiler cannot know.
#ifdef __clang__
#pragma clang loop vectorize(assume_safety)
#else
#pragma GCC ivdep
#endif
    for (std::int32_t j = 0; j < count; ++j) work[items[j]] += value * numbers[j];
  }
}

// solution (+)= projection of (right_side - row of the matrix times solution) / diagonal.
template <class Scalar, int Dim, bool Ascends>
inline void relax_row(const Level<Scalar>& level, std::int32_t row, std::size_t size,
                      Scalar* work) {
  using Numbers = PackN<Scalar, 8>;
  if (level.lists.counts[row] == 0) return;
  const std::size_t start = level.lists.starts[row];
  const std::size_t length = level.lists.starts[row + 1] - start;
  const std::uint16_t* items = level.lists.items + start;
  Scalar* solution = level.solution + start;
  std::memset(work, 0, size * sizeof(Scalar));
  add_products(level.lower, row, level.lists, level.solution, work);
  if (Ascends) {
    add_products(level.upper, row, level.lists, level.solution, work);
    // The row itself; the change is divided by its diagonal entry.
    const Scalar diagonal = 1 / level.inverse_diagonal[row];
    for (std::int32_t j = 0; j < level.lists.counts[row]; ++j) {
      work[items[j]] += diagonal * solution[j];
    }
  }
  Scalar* residual = work + size;
  const Scalar* right_side = level.right_side + start;
  for (std::size_t j = 0; j < length; ++j) residual[j] = right_side[j] - work[items[j]];
  const Scalar* basis = level.basis + (Dim + 1) * start;
  Scalar excess[Dim + 1];
  for (int k = 0; k <= Dim; ++k) {
    Numbers sum{};
    for (std::size_t j = 0; j < length; j += 8) {
      sum += load_pack<8>(basis + k * length + j) * load_pack<8>(residual + j);
    }
    excess[k] = 0;
    for (int l = 0; l < 8; ++l) excess[k] += sum[l];
  }
  const Scalar scale = level.inverse_diagonal[row];
  for (std::size_t j = 0; j < length; j += 8) {
    Numbers r = load_pack<8>(residual + j);
    for (int k = 0; k <= Dim; ++k) r -= excess[k] * load_pack<8>(basis + k * length + j);
    r *= scale;
    if (Ascends) r += load_pack<8>(solution + j);
    store_pack<8>(solution + j, r);
  }
}

template <class Scalar, int Dim>
void descend(const Level<Scalar>& level, std::int32_t begin, std::int32_t end, std::size_t size,
             Scalar* work) {
  for (std::int32_t row = begin; row < end; ++row) {
    relax_row<Scalar, Dim, false>(level, row, size, work);
  }
}

template <class Scalar, int Dim>
void ascend(const Level<Scalar>& level, std::int32_t begin, std::int32_t end, std::size_t size,
            Scalar* work) {
  for (std::int32_t row = end; row-- > begin;) {
    relax_row<Scalar, Dim, true>(level, row, size, work);
  }
}

template <class Scalar>
void multiply(const Entries<Scalar>& entries, const Lists& target_lists, const Lists& source_lists,
              Scalar factor, const Scalar* source, bool adds, Scalar* target, std::int32_t begin,
              std::int32_t end, std::size_t size, Scalar* work) {
  for (std::int32_t row = begin; row < end; ++row) {
    std::memset(work, 0, size * sizeof(Scalar));
    add_products(entries, row, source_lists, source, work);
    const std::size_t start = target_lists.starts[row];
    for (std::int32_t j = 0; j < target_lists.counts[row]; ++j) {
      const Scalar product = factor * work[target_lists.items[start + j]];
      target[start + j] = adds ? target[start + j] + product : product;
    }
  }
}

template <class Scalar>
void gather(const Lists& lists, const std::int32_t* rows, std::int32_t count,
            const std::uint16_t* slot_of, const Scalar* numbers, std::size_t stride,
            Scalar* block) {
  std::memset(block, 0, count * stride * sizeof(Scalar));
  for (std::int32_t k = 0; k < count; ++k) {
    const std::size_t start = lists.starts[rows[k]];
    Scalar* dense = block + k * stride;
    for (std::int32_t j = 0; j < lists.counts[rows[k]]; ++j) {
      dense[slot_of[lists.items[start + j]]] = numbers[start + j];
    }
  }
}

template <class Scalar>
void scatter(const Lists& lists, const std::int32_t* rows, std::int32_t count,
             const std::uint16_t* slot_of, const Scalar* block, std::size_t stride,
             const std::size_t* starts, Scalar* numbers) {
  for (std::int32_t k = 0; k < count; ++k) {
    const std::uint16_t* items = lists.items + lists.starts[rows[k]];
    const Scalar* dense = block + k * stride;
    Scalar* row = numbers + starts[k];
    for (std::int32_t j = 0; j < lists.counts[rows[k]]; ++j) row[j] = dense[slot_of[items[j]]];
  }
}

template <class Scalar, int Dim>
constexpr Kernel<Scalar, Dim> kKernel{descend<Scalar, Dim>, ascend<Scalar, Dim>, multiply<Scalar>,
                                      gather<Scalar>, scatter<Scalar>};

}  // namespace
}  // namespace flbc::active_set::FLBC_ISA

namespace flbc {
FLBC_DEFINE_KERNELS(active_set)
}  // namespace flbc
