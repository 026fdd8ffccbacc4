// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! The steps of the compact splitting for one cell or one row. Included by compact_kernel.inl
//! within its namespace of the instruction set.

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

template <class Scalar, class Stored, int Dim, int Lanes>
[[gnu::always_inline]] inline void load_cell_dual(const Arrays<Scalar, Dim>& arrays, std::size_t s,
                                                  std::size_t i, PackN<Scalar, Lanes>* dual) {
  const Stored* rows = static_cast<const Stored*>(arrays.cell_dual) + s * Dim * arrays.cell_stride;
  for (int d = 0; d < Dim; ++d) dual[d] = load_stored<Lanes>(rows + d * arrays.cell_stride + i);
}

// theta field + (1 - theta) clip(field), where clip shortens to the cell's radius.
template <class Scalar, class Stored, int Dim, int Lanes>
[[gnu::always_inline]] inline void clip(const Arrays<Scalar, Dim>& arrays, std::size_t s,
                                        std::size_t i, PackN<Scalar, Lanes>* field) {
  const PackN<Scalar, Lanes> radius =
      load_stored<Lanes>(static_cast<const Stored*>(arrays.radius) + s * arrays.cell_stride + i);
  PackN<Scalar, Lanes> length2 = field[0] * field[0];
  for (int d = 1; d < Dim; ++d) length2 += field[d] * field[d];
  const PackN<Scalar, Lanes> shrink = shrinkage<Stored, Scalar, Lanes>(radius, length2);
  const PackN<Scalar, Lanes> factor = arrays.smoothing + (Scalar(1) - arrays.smoothing) * shrink;
  for (int d = 0; d < Dim; ++d) field[d] *= factor;
}

// Z-step and dual step: P += relaxation (clip(P + G a) - P).
template <class Scalar, class Stored, int Dim, int Interior, bool Measured, int Lanes>
[[gnu::always_inline]] inline void z_step_at(const Arrays<Scalar, Dim>& arrays, std::size_t s,
                                             std::size_t i) {
  using Numbers = PackN<Scalar, Lanes>;
  const Cell<Scalar, Dim>& cell = arrays.cells[s];
  const std::size_t stride = arrays.stride;
  Stored* rows = static_cast<Stored*>(arrays.cell_dual) + s * Dim * arrays.cell_stride + i;
  Numbers dual[Dim];
  Numbers clipped[Dim];
  for (int d = 0; d < Dim; ++d)
    clipped[d] = dual[d] = load_stored<Lanes>(rows + d * arrays.cell_stride);
  add_gradient<Scalar, Dim, Lanes>(cell, arrays.extrapolated, stride, i, clipped);
  clip<Scalar, Stored, Dim, Lanes>(arrays, s, i, clipped);
  if constexpr (Measured) {
    Numbers step[Dim];
    for (int d = 0; d < Dim; ++d) step[d] = dual[d] - clipped[d];
    add_gradient<Scalar, Dim, Lanes>(cell, arrays.difference, stride, i, step);
    Scalar* sum = arrays.violation_sum + i;
    Numbers violation = load_pack<Lanes>(sum);
    for (int d = 0; d < Dim; ++d) violation += step[d] * step[d];
    store_pack<Lanes>(sum, violation);
  }
  const Scalar keep = Scalar(1) - arrays.relaxation;
  for (int d = 0; d < Dim; ++d) {
    dual[d] = keep * dual[d] + arrays.relaxation * clipped[d];
    store_stored<Lanes>(rows + d * arrays.cell_stride, dual[d]);
  }
  subtract_divergence<Scalar, Dim, Interior, Lanes>(cell, arrays.residual, stride, i, dual);
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
// \param w  needed only to measure the violation of u = w, where u = max(0, a - S)
template <class Scalar, int Dim, bool Measured, int Lanes>
[[gnu::always_inline]] inline void w_step_at(const Arrays<Scalar, Dim>& arrays, std::size_t row,
                                             std::size_t i, PackN<Scalar, Lanes> a,
                                             PackN<Scalar, Lanes> w, LaneSum<Scalar>& violation) {
  using Numbers = PackN<Scalar, Lanes>;
  Scalar* residual = arrays.residual + row * arrays.stride + i;
  if (arrays.vertex_dual == nullptr) {
    store_pack<Lanes>(residual, Numbers{});
    return;
  }
  const Scalar metric = arrays.vertex_metric[row];
  Scalar* place = arrays.vertex_dual + row * arrays.stride + i;
  const Numbers dual = load_pack<Lanes>(place);
  const Numbers excess = dual - a;
  const Numbers next = (Scalar(1) - arrays.relaxation) * dual +
                       arrays.relaxation * (excess > Numbers{} ? excess : Numbers{});
  store_pack<Lanes>(place, next);
  store_pack<Lanes>(residual, metric * next);
  if constexpr (Measured) {
    const Numbers step = (excess < Numbers{} ? -excess : Numbers{}) - w;
    violation.template add<Lanes>(metric * step * step);
  }
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
template <class Scalar, int Dim, bool Measured>
inline RowSums y_step_at(const Arrays<Scalar, Dim>& arrays, std::size_t row) {
  Scalar* extrapolated = arrays.extrapolated + row * arrays.stride;
  Scalar* relaxed = arrays.relaxed + row * arrays.stride;
  // W += relaxation (w - W) with w = (a + W) / 2.
  const auto next = [&](auto lanes, std::size_t i) __attribute__((always_inline)) {
    const auto W = load_pack<lanes()>(relaxed + i);
    return W + Scalar(0.5) * arrays.relaxation * (load_pack<lanes()>(extrapolated + i) - W);
  };
  LaneSum<Scalar> change;
  LaneSum<Scalar> violation;
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
        w_step_at<Scalar, Dim, Measured, lanes()>(arrays, row, i, a, w, violation);
      });
  return {static_cast<double>(change.total()), static_cast<double>(violation.total())};
}

// a += the solution, projected; the residual is cleared.
template <class Scalar, int Dim>
inline RowSums correct_at(const Arrays<Scalar, Dim>& arrays, std::size_t row) {
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
  return {static_cast<double>(change.total()), 0};
}
