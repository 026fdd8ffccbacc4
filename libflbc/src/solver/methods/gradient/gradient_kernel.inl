// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! The loops, included once per instruction set with FLBC_ISA as its name. Each including file is
//! compiled with the flags of that set (see libflbc/CMakeLists.txt).

#include "base/simd.h"
#include "solver/methods/gradient/gradient_kernel.h"

namespace flbc::gradient::FLBC_ISA {
namespace {

#include "solver/methods/gradient/lane_sums.inl"
// after what it uses
#include "solver/methods/gradient/gradient_steps.inl"

template <class Scalar, int Dim>
Scalar* extrapolated_of(const Arrays<Scalar, Dim>& arrays, std::int32_t cell) {
  return arrays.extrapolated + std::size_t(cell) * Dim * arrays.stride;
}

// On the boundary there is no second cell; its value is unused.
template <bool note, class Scalar, int Dim>
inline void xy_step_at(const Arrays<Scalar, Dim>& arrays, std::int32_t facet) {
  const std::int32_t first = arrays.sides[2 * facet];
  const std::int32_t second = arrays.sides[2 * facet + 1];
  const double change = xy_step_at<note>(arrays, facet, extrapolated_of(arrays, first),
                                         extrapolated_of(arrays, second < 0 ? first : second));
  if constexpr (note) arrays.facet_change[facet] = change;
}

template <class Scalar, int Dim>
void xy_step(const Arrays<Scalar, Dim>& arrays, std::int32_t begin, std::int32_t end) {
  for (std::int32_t facet = begin; facet < end; ++facet) xy_step_at<true>(arrays, facet);
}

template <class Scalar, int Dim>
void listed_xy_step(const Arrays<Scalar, Dim>& arrays, const std::int32_t* facets,
                    std::size_t count, bool noted) {
  for (std::size_t k = 0; k < count; ++k) {
    noted ? xy_step_at<true>(arrays, facets[k]) : xy_step_at<false>(arrays, facets[k]);
  }
}

template <class Scalar, int Dim>
void z_step(const Arrays<Scalar, Dim>& arrays, std::int32_t begin, std::int32_t end) {
  for (std::int32_t cell = begin; cell < end; ++cell) {
    const Scalar* extrapolated = extrapolated_of(arrays, cell);
    SquareSum<Scalar, true> change;
    for_packs<kWide<Scalar>>(
        0, arrays.stride, [&](auto lanes, std::size_t i) __attribute__((always_inline)) {
          PackN<Scalar, lanes()> e[Dim];
          for (int d = 0; d < Dim; ++d) {
            e[d] = load_pack<lanes()>(extrapolated + d * arrays.stride + i);
          }
          z_step_at<lanes()>(arrays, cell, i, e, change);
        });
    arrays.cell_change[cell] = change.total();
  }
}

template <class Scalar, int Dim>
Change g_step(const Arrays<Scalar, Dim>& arrays, std::int32_t begin, std::int32_t end) {
  Change change;
  for (std::int32_t cell = begin; cell < end; ++cell) {
    change += g_step_at<true, false, false>(arrays, cell, extrapolated_of(arrays, cell));
  }
  return change;
}

// Always inlined, because compilers drop calls to functions that only prefetch.
template <class Scalar>
[[gnu::always_inline]] inline void prefetch(const Scalar* from, std::size_t count) {
  constexpr std::size_t kLine = 64 / sizeof(Scalar);
  for (std::size_t i = 0; i < count; i += kLine) __builtin_prefetch(from + i, 1);
}

// Prefetches the data of a cell visit. Facet duals are not in the order of the cells, and the
// hardware prefetcher cannot follow this many streams.
template <class Scalar, int Dim>
[[gnu::always_inline]] inline void prefetch_cell(const Arrays<Scalar, Dim>& arrays,
                                                 std::int32_t cell) {
  const std::size_t stride = arrays.stride;
  const std::size_t rows = Dim * stride;
  prefetch(arrays.gradient + std::size_t(cell) * rows, rows);
  prefetch(arrays.tv_dual + std::size_t(cell) * rows, rows);
  prefetch(arrays.radius + std::size_t(cell) * stride, stride);
  for (int k = 0; k <= Dim; ++k) {
    const std::int32_t facet = arrays.cell_facets[std::size_t(cell) * (Dim + 1) + k];
    prefetch(arrays.facet_dual + std::size_t(facet) * (Dim - 1) * stride, (Dim - 1) * stride);
  }
}

// The number of visits that take as long as a memory access.
constexpr std::size_t kVisitsAhead = 4;

template <bool note, class Scalar, int Dim>
void pass(const Arrays<Scalar, Dim>& arrays, const PassPath& path, Scalar* slots) {
  const auto extrapolated = [&](Place place) {
    return place >= 0 ? slots + std::size_t(place) * Dim * arrays.stride
                      : extrapolated_of(arrays, ~place);
  };
  const Closing* closing = path.closings;
  for (std::size_t k = 0; k < path.num_visits; ++k) {
    const Visit visit = path.visits[k];
    if (k + kVisitsAhead < path.num_visits) {
      prefetch_cell(arrays, path.visits[k + kVisitsAhead].cell);
    }
    const Place place = note ? ~visit.cell : visit.place;
    const double change =
        g_step_at<false, true, note>(arrays, visit.cell, extrapolated(place)).dual;
    if constexpr (note) arrays.cell_change[visit.cell] = change;
    for (const Closing* end = closing + visit.num_closings; closing < end; ++closing) {
      if constexpr (note) {
        xy_step_at<true>(arrays, closing->facet);
      } else {
        xy_step_at<false>(arrays, closing->facet, extrapolated(closing->first),
                          extrapolated(closing->second));
      }
    }
  }
}

template <class Scalar, int Dim>
constexpr Kernel<Scalar, Dim> kKernel{xy_step<Scalar, Dim>,     listed_xy_step<Scalar, Dim>,
                                      z_step<Scalar, Dim>,      g_step<Scalar, Dim>,
                                      pass<false, Scalar, Dim>, pass<true, Scalar, Dim>};

}  // namespace
}  // namespace flbc::gradient::FLBC_ISA

namespace flbc {
FLBC_DEFINE_KERNELS(gradient)
}  // namespace flbc
