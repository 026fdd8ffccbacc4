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

template <class Scalar, int Lanes>
inline Scalar sum_of(PackN<Scalar, Lanes> pack) {
  if constexpr (Lanes == 16) {
    return sum_of<Scalar, 8>(fold<Scalar>(pack));
  } else {
    const auto four = __builtin_shufflevector(pack, pack, 0, 1, 2, 3) +
                      __builtin_shufflevector(pack, pack, 4, 5, 6, 7);
    const auto two =
        __builtin_shufflevector(four, four, 0, 1) + __builtin_shufflevector(four, four, 2, 3);
    return two[0] + two[1];
  }
}

// Sums over a row, from wide packs and the remainder.
template <class Scalar>
struct LaneSum {
  PackN<Scalar, kWideLanes> wide{};
  PackN<Scalar, 8> rest{};

  template <int Lanes>
  [[gnu::always_inline]] void add(PackN<Scalar, Lanes> pack) {
    if constexpr (Lanes == kWideLanes) {
      wide += pack;
    } else {
      rest += pack;
    }
  }
  Scalar total() const { return sum_of<Scalar, kWideLanes>(wide) + sum_of<Scalar, 8>(rest); }
};

// ---- steps of one cell or row -------------------------------------------------------------------

// field += G v for the rows of v.
template <class Scalar, int Dim, int Lanes>
[[gnu::always_inline]] inline void add_gradient(const Cell<Scalar, Dim>& cell, const Scalar* rows,
                                                std::size_t stride, std::size_t i,
                                                PackN<Scalar, Lanes>* field) {
  const auto first = load_pack<Lanes>(rows + std::size_t(cell.rows[0]) * stride + i);
  for (int k = 1; k <= Dim; ++k) {
    const auto difference = load_pack<Lanes>(rows + std::size_t(cell.rows[k]) * stride + i) - first;
    for (int d = 0; d < Dim; ++d) field[d] += cell.hats[k][d] * difference;
  }
}

// residual -= G^T field, for the interior corners.
template <class Scalar, int Dim, int Interior, int Lanes>
[[gnu::always_inline]] inline void subtract_divergence(const Cell<Scalar, Dim>& cell,
                                                       Scalar* residual, std::size_t stride,
                                                       std::size_t i,
                                                       const PackN<Scalar, Lanes>* field) {
  for (int k = 0; k < Interior; ++k) {
    Scalar* row = residual + std::size_t(cell.rows[k]) * stride + i;
    auto sum = load_pack<Lanes>(row);
    for (int d = 0; d < Dim; ++d) sum -= cell.hats[k][d] * field[d];
    store_pack<Lanes>(row, sum);
  }
}

// theta field + (1 - theta) clip(field), where clip shortens to the cell's radius.
template <class Scalar, int Dim, int Lanes>
[[gnu::always_inline]] inline void clip(const Arrays<Scalar, Dim>& arrays, std::size_t s,
                                        std::size_t i, PackN<Scalar, Lanes>* field) {
  using Numbers = PackN<Scalar, Lanes>;
  const auto radius = load_pack<Lanes>(arrays.radius + s * arrays.cell_stride + i);
  Numbers length2 = field[0] * field[0];
  for (int d = 1; d < Dim; ++d) length2 += field[d] * field[d];
  const Numbers least2 = radius * radius + std::numeric_limits<Scalar>::min();
  const Numbers shrink =
      radius * inverse_square_root<Scalar, Lanes>(length2 > least2 ? length2 : least2);
  const Numbers factor = arrays.smoothing + (Scalar(1) - arrays.smoothing) * shrink;
  for (int d = 0; d < Dim; ++d) field[d] *= factor;
}

// Z-step and dual step: P += relaxation (clip(P + G a) - P).
template <class Scalar, int Dim, int Interior, int Lanes>
[[gnu::always_inline]] inline void z_step_at(const Arrays<Scalar, Dim>& arrays, std::size_t s,
                                             std::size_t i) {
  using Numbers = PackN<Scalar, Lanes>;
  const Cell<Scalar, Dim>& cell = arrays.cells[s];
  Scalar* rows = arrays.cell_dual + s * Dim * arrays.cell_stride + i;
  Numbers dual[Dim];
  Numbers clipped[Dim];
  for (int d = 0; d < Dim; ++d) {
    clipped[d] = dual[d] = load_pack<Lanes>(rows + d * arrays.cell_stride);
  }
  add_gradient<Scalar, Dim, Lanes>(cell, arrays.extrapolated, arrays.stride, i, clipped);
  clip<Scalar, Dim, Lanes>(arrays, s, i, clipped);
  const Scalar keep = Scalar(1) - arrays.relaxation;
  for (int d = 0; d < Dim; ++d) {
    dual[d] = keep * dual[d] + arrays.relaxation * clipped[d];
    store_pack<Lanes>(rows + d * arrays.cell_stride, dual[d]);
  }
  subtract_divergence<Scalar, Dim, Interior, Lanes>(cell, arrays.residual, arrays.stride, i, dual);
}

template <class Scalar, int Dim, int Interior, int Lanes>
[[gnu::always_inline]] inline void harmonic_residual_at(const Arrays<Scalar, Dim>& arrays,
                                                        std::size_t s, std::size_t i) {
  PackN<Scalar, Lanes> gradient[Dim] = {};
  add_gradient<Scalar, Dim, Lanes>(arrays.cells[s], arrays.extrapolated, arrays.stride, i,
                                   gradient);
  subtract_divergence<Scalar, Dim, Interior, Lanes>(arrays.cells[s], arrays.residual, arrays.stride,
                                                    i, gradient);
}

// W-step and dual step: S += relaxation (max(0, S - a) - S), and k S goes to the residual.
template <class Scalar, int Dim, int Lanes>
[[gnu::always_inline]] inline void w_step_at(const Arrays<Scalar, Dim>& arrays, std::size_t row,
                                             std::size_t i, PackN<Scalar, Lanes> a) {
  using Numbers = PackN<Scalar, Lanes>;
  Scalar* residual = arrays.residual + row * arrays.stride + i;
  if (arrays.vertex_dual == nullptr) {
    store_pack<Lanes>(residual, Numbers{});
    return;
  }
  Scalar* place = arrays.vertex_dual + row * arrays.stride + i;
  const Numbers dual = load_pack<Lanes>(place);
  const Numbers excess = dual - a;
  const Numbers next = (Scalar(1) - arrays.relaxation) * dual +
                       arrays.relaxation * (excess > Numbers{} ? excess : Numbers{});
  store_pack<Lanes>(place, next);
  store_pack<Lanes>(residual, arrays.vertex_metric[row] * next);
}

// Projects a row onto { sum w = 1, sum w c = x } and calls `use(lanes, column, w)` for its packs.
// \param candidate  function of (lanes, column): the values to project, minus the solution
template <class Scalar, int Dim, class Candidate, class Use>
[[gnu::always_inline]] inline void project_row(const Arrays<Scalar, Dim>& arrays, std::size_t row,
                                               const Candidate& candidate, const Use& use) {
  const std::size_t stride = arrays.stride;
  Scalar* solution = arrays.residual + row * stride;
  LaneSum<Scalar> projection[Dim + 1];
  for_packs<kWideLanes>(
      0, stride, [&](auto lanes, std::size_t i) __attribute__((always_inline)) {
        const PackN<Scalar, lanes()> r = candidate(lanes, i) + load_pack<lanes()>(solution + i);
        store_pack<lanes()>(solution + i, r);
        for (int k = 0; k <= Dim; ++k) {
          projection[k].template add<lanes()>(load_pack<lanes()>(arrays.basis + k * stride + i) *
                                              r);
        }
      });
  Scalar excess[Dim + 1];  // of Q^T r
  const Scalar* target = arrays.row_target + row * (Dim + 1);
  for (int k = 0; k <= Dim; ++k) excess[k] = projection[k].total() - arrays.sigma * target[k];
  for_packs<kWideLanes>(
      0, stride, [&](auto lanes, std::size_t i) __attribute__((always_inline)) {
        PackN<Scalar, lanes()> w = load_pack<lanes()>(solution + i);
        for (int k = 0; k <= Dim; ++k) {
          w -= excess[k] * load_pack<lanes()>(arrays.basis + k * stride + i);
        }
        use(lanes, i, w);
      });
}

// Y-step: W relaxed, w = W + the solution, projected. Then the next W-step.
template <class Scalar, int Dim>
inline double y_step_at(const Arrays<Scalar, Dim>& arrays, std::size_t row) {
  Scalar* extrapolated = arrays.extrapolated + row * arrays.stride;
  Scalar* relaxed = arrays.relaxed + row * arrays.stride;
  // W += relaxation (w - W) with w = (a + W) / 2.
  const auto next = [&](auto lanes, std::size_t i) __attribute__((always_inline)) {
    const auto W = load_pack<lanes()>(relaxed + i);
    return W + Scalar(0.5) * arrays.relaxation * (load_pack<lanes()>(extrapolated + i) - W);
  };
  LaneSum<Scalar> change;
  project_row(
      arrays, row, next, [&](auto lanes, std::size_t i, auto w) __attribute__((always_inline)) {
        using Numbers = PackN<Scalar, lanes()>;
        const Numbers before =
            Scalar(0.5) * (load_pack<lanes()>(extrapolated + i) + load_pack<lanes()>(relaxed + i));
        const Numbers W = next(lanes, i);
        const Numbers a = Scalar(2) * w - W;
        change.template add<lanes()>((w - before) * (w - before));
        store_pack<lanes()>(relaxed + i, W);
        store_pack<lanes()>(extrapolated + i, a);
        w_step_at<Scalar, Dim, lanes()>(arrays, row, i, a);
      });
  return static_cast<double>(change.total());
}

// a += the solution, projected; the residual is cleared.
template <class Scalar, int Dim>
inline double correct_at(const Arrays<Scalar, Dim>& arrays, std::size_t row) {
  Scalar* weights = arrays.extrapolated + row * arrays.stride;
  Scalar* solution = arrays.residual + row * arrays.stride;
  LaneSum<Scalar> change;
  project_row(
      arrays, row,
      [&](auto lanes, std::size_t i)
          __attribute__((always_inline)) { return load_pack<lanes()>(weights + i); },
      [&](auto lanes, std::size_t i, auto w) __attribute__((always_inline)) {
        const PackN<Scalar, lanes()> step = w - load_pack<lanes()>(weights + i);
        change.template add<lanes()>(step * step);
        store_pack<lanes()>(weights + i, w);
        store_pack<lanes()>(solution + i, PackN<Scalar, lanes()>{});
      });
  return static_cast<double>(change.total());
}

// ---- loops --------------------------------------------------------------------------------------

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

template <class Scalar, int Dim>
void z_step(const Arrays<Scalar, Dim>& arrays, Columns columns) {
  for_cells(
      arrays, [&](auto corners, std::size_t s) __attribute__((always_inline)) {
        for_packs<kWideLanes>(
            columns.begin,
            columns.end, [&](auto lanes, std::size_t i) __attribute__((always_inline)) {
              z_step_at<Scalar, Dim, corners(), lanes()>(arrays, s, i);
            });
      });
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
inline double over_rows(std::int32_t begin, std::int32_t end, const Step& step) {
  double sum = 0;
  for (std::int32_t row = begin; row < end; ++row) sum += step(std::size_t(row));
  return sum;
}

template <class Scalar, int Dim>
double y_step(const Arrays<Scalar, Dim>& arrays, std::int32_t begin, std::int32_t end) {
  return over_rows(begin, end, [&](std::size_t row) { return y_step_at(arrays, row); });
}

template <class Scalar, int Dim>
double correct(const Arrays<Scalar, Dim>& arrays, std::int32_t begin, std::int32_t end) {
  return over_rows(begin, end, [&](std::size_t row) { return correct_at(arrays, row); });
}

template <class Scalar, int Dim>
double w_step(const Arrays<Scalar, Dim>& arrays, std::int32_t begin, std::int32_t end) {
  return over_rows(begin, end, [&](std::size_t row) {
    const Scalar* a = arrays.extrapolated + row * arrays.stride;
    for_packs<kWideLanes>(
        0, arrays.stride, [&](auto lanes, std::size_t i) __attribute__((always_inline)) {
          w_step_at<Scalar, Dim, lanes()>(arrays, row, i, load_pack<lanes()>(a + i));
        });
    return 0.0;
  });
}

// Calls `body(cell, column)` for all cells and packs of 8 columns.
template <class Scalar, int Dim, class Body>
inline void for_numbers(const Arrays<Scalar, Dim>& arrays, Columns columns, const Body& body) {
  for (std::size_t s = 0; s < arrays.num_cells; ++s) {
    for (std::size_t i = columns.begin; i < columns.end; i += 8) body(s, i);
  }
}

template <class Scalar, int Dim>
void start_cell_dual(const Arrays<Scalar, Dim>& arrays, Columns columns) {
  for_numbers(arrays, columns, [&](std::size_t s, std::size_t i) {
    Scalar* rows = arrays.cell_dual + s * Dim * arrays.cell_stride;
    PackN<Scalar, 8> gradient[Dim] = {};
    add_gradient<Scalar, Dim, 8>(arrays.cells[s], arrays.extrapolated, arrays.stride, i, gradient);
    for (int d = 0; d < Dim; ++d) store_pack<8>(rows + d * arrays.cell_stride + i, gradient[d]);
  });
}

// field += P.
template <class Scalar, int Dim>
inline void add_cell_dual(const Arrays<Scalar, Dim>& arrays, std::size_t s, std::size_t i,
                          PackN<Scalar, 8>* field) {
  const Scalar* rows = arrays.cell_dual + s * Dim * arrays.cell_stride;
  for (int d = 0; d < Dim; ++d) field[d] += load_pack<8>(rows + d * arrays.cell_stride + i);
}

template <class Scalar, int Dim>
void flux(const Arrays<Scalar, Dim>& arrays, Columns columns, const Scalar* scale, Scalar* flux) {
  for_numbers(arrays, columns, [&](std::size_t s, std::size_t i) {
    const auto cell = std::size_t(arrays.cell_index[s]);
    PackN<Scalar, 8> p[Dim] = {};
    add_cell_dual(arrays, s, i, p);
    add_gradient<Scalar, Dim, 8>(arrays.cells[s], arrays.extrapolated, arrays.stride, i, p);
    clip<Scalar, Dim, 8>(arrays, s, i, p);
    for (int d = 0; d < Dim; ++d) {
      store_pack<8>(flux + (cell * Dim + d) * arrays.stride + i, scale[cell] * p[d]);
    }
  });
}

template <int Dim, class Numbers>
inline void add_squares(const Numbers* field, double* sums) {
  Numbers length2 = field[0] * field[0];
  for (int d = 1; d < Dim; ++d) length2 += field[d] * field[d];
  for (std::size_t l = 0; l < 8; ++l) sums[l] += static_cast<double>(length2[l]);
}

template <class Scalar, int Dim>
void residuals(const Arrays<Scalar, Dim>& arrays, Columns columns, const Scalar* moved,
               double* motion, double* violation) {
  using Numbers = PackN<Scalar, 8>;
  for_numbers(arrays, columns, [&](std::size_t s, std::size_t i) {
    const auto& cell = arrays.cells[s];
    Numbers gradient[Dim] = {};
    add_gradient<Scalar, Dim, 8>(cell, moved, arrays.stride, i, gradient);
    add_squares<Dim>(gradient, motion + i);
    // z - grad w = P + G (w - W) - clip(P + G a)
    Numbers dual[Dim] = {};
    Numbers clipped[Dim] = {};
    add_cell_dual(arrays, s, i, dual);
    add_cell_dual(arrays, s, i, clipped);
    add_gradient<Scalar, Dim, 8>(cell, arrays.difference, arrays.stride, i, dual);
    add_gradient<Scalar, Dim, 8>(cell, arrays.extrapolated, arrays.stride, i, clipped);
    clip<Scalar, Dim, 8>(arrays, s, i, clipped);
    for (int d = 0; d < Dim; ++d) dual[d] -= clipped[d];
    add_squares<Dim>(dual, violation + i);
  });
}

template <class Scalar, int Dim>
constexpr Kernel<Scalar, Dim> kKernel{z_step<Scalar, Dim>,  y_step<Scalar, Dim>,
                                      w_step<Scalar, Dim>,  harmonic_residual<Scalar, Dim>,
                                      correct<Scalar, Dim>, start_cell_dual<Scalar, Dim>,
                                      flux<Scalar, Dim>,    residuals<Scalar, Dim>};

}  // namespace
}  // namespace flbc::compact::FLBC_ISA

namespace flbc {
FLBC_DEFINE_KERNELS(compact)
}  // namespace flbc
