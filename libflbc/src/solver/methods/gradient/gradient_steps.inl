// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! The steps of the iteration for one facet or one cell. Included by gradient_kernel.inl within its
//! namespace of the instruction set. Steps with `note` return or accumulate their changes.

// (9), (10): the dual of a boundary facet grows by the violation of t . g = h, that of an interior
// facet by half the jump of the tangential gradient. \return the squared change per side
template <bool note, class Scalar, int Dim>
inline double xy_step_at(const Arrays<Scalar, Dim>& arrays, std::int32_t facet, const Scalar* first,
                         const Scalar* second) {
  constexpr int kTangents = Dim - 1;
  const std::size_t stride = arrays.stride;
  const Scalar* tangents = arrays.tangents + std::size_t(facet) * kTangents * Dim;
  Scalar* dual = arrays.facet_dual + std::size_t(facet) * kTangents * stride;
  SquareSum<Scalar, note> change;
  const std::int32_t boundary = arrays.boundary_index[facet];
  if (boundary >= 0) {
    const Scalar* slope = arrays.boundary_slope + std::size_t(boundary) * kTangents * stride;
    for_packs<kWide<Scalar>>(
        0, stride, [&](auto lanes, std::size_t i) __attribute__((always_inline)) {
          for (int t = 0; t < kTangents; ++t) {
            auto step = load_pack<lanes()>(slope + t * stride + i);
            for (int d = 0; d < Dim; ++d) {
              step -= tangents[t * Dim + d] * load_pack<lanes()>(first + d * stride + i);
            }
            Scalar* place = dual + t * stride + i;
            store_pack<lanes()>(place, load_pack<lanes()>(place) + arrays.relaxation * step);
            change.template add<lanes()>(step);
          }
        });
    return note ? change.total() : 0;
  }
  for_packs<kWide<Scalar>>(
      0, stride, [&](auto lanes, std::size_t i) __attribute__((always_inline)) {
        PackN<Scalar, lanes()> half_jump[Dim];
        for (int d = 0; d < Dim; ++d) {
          half_jump[d] = Scalar(0.5) * (load_pack<lanes()>(second + d * stride + i) -
                                        load_pack<lanes()>(first + d * stride + i));
        }
        for (int t = 0; t < kTangents; ++t) {
          PackN<Scalar, lanes()> step{};
          for (int d = 0; d < Dim; ++d) step += tangents[t * Dim + d] * half_jump[d];
          Scalar* place = dual + t * stride + i;
          store_pack<lanes()>(place, load_pack<lanes()>(place) + arrays.relaxation * step);
          change.template add<lanes()>(step);
        }
      });
  return note ? 2 * change.total() : 0;
}

// Z-step: the dual of Z = G is minus theta v + (1 - theta) clip(v), where v = extrapolated - dual,
// clip projects onto the ball of radius phi A / mu, and theta is the smoothing of the cell.
template <int lanes, bool note, class Scalar, int Dim>
[[gnu::always_inline]] inline void z_step_at(const Arrays<Scalar, Dim>& arrays, std::int32_t cell,
                                             std::size_t i,
                                             const PackN<Scalar, lanes>* extrapolated,
                                             SquareSum<Scalar, note>& change) {
  using P = PackN<Scalar, lanes>;
  Scalar* place = arrays.tv_dual + std::size_t(cell) * Dim * arrays.stride + i;
  const P radius = load_pack<lanes>(arrays.radius + std::size_t(cell) * arrays.stride + i);
  P norm2 = radius * radius + std::numeric_limits<Scalar>::min();
  P length2{};
  P dual[Dim];
  for (int d = 0; d < Dim; ++d) {
    dual[d] = load_pack<lanes>(place + d * arrays.stride);
    const P v = extrapolated[d] - dual[d];
    length2 += v * v;
  }
  norm2 = length2 > norm2 ? length2 : norm2;
  const Scalar theta = arrays.smoothing[cell];
  const P shrink =
      theta + (Scalar(1) - theta) * (radius * inverse_square_root<Scalar, lanes>(norm2));
  for (int d = 0; d < Dim; ++d) {
    const P step = shrink * (dual[d] - extrapolated[d]) - dual[d];
    store_pack<lanes>(place + d * arrays.stride, dual[d] + arrays.relaxation * step);
    change.template add<lanes>(step);
  }
}

// One facet of a cell: the direction of the dual, signed for this cell.
template <class Scalar, int Dim>
struct FacetMultiplier {
  const Scalar* dual;
  Scalar tangents[Dim - 1][Dim];
};

template <class Scalar, int Dim>
[[gnu::always_inline]] inline void gather_facets(const Arrays<Scalar, Dim>& arrays,
                                                 std::int32_t cell,
                                                 FacetMultiplier<Scalar, Dim>* multipliers) {
  for (int k = 0; k <= Dim; ++k) {
    const std::int32_t facet = arrays.cell_facets[std::size_t(cell) * (Dim + 1) + k];
    const Scalar sign = arrays.sides[2 * facet] == cell ? Scalar(1) : Scalar(-1);
    multipliers[k].dual = arrays.facet_dual + std::size_t(facet) * (Dim - 1) * arrays.stride;
    for (int t = 0; t < Dim - 1; ++t) {
      for (int d = 0; d < Dim; ++d) {
        multipliers[k].tangents[t][d] =
            sign * arrays.tangents[(std::size_t(facet) * (Dim - 1) + t) * Dim + d];
      }
    }
  }
}

// Average of all candidates for the gradient of the cell, r_s of (11): g + (sum of its duals) / M.
template <int lanes, class Scalar, int Dim>
[[gnu::always_inline]] inline void average_candidates(
    const Arrays<Scalar, Dim>& arrays, std::int32_t cell,
    const FacetMultiplier<Scalar, Dim>* multipliers, std::size_t i, PackN<Scalar, lanes>* average) {
  using P = PackN<Scalar, lanes>;
  const std::size_t stride = arrays.stride;
  const std::size_t row = std::size_t(cell) * Dim * stride + i;
  for (int d = 0; d < Dim; ++d) average[d] = load_pack<lanes>(arrays.tv_dual + row + d * stride);
  for (int k = 0; k <= Dim; ++k) {
    for (int t = 0; t < Dim - 1; ++t) {
      const P dual = load_pack<lanes>(multipliers[k].dual + t * stride + i);
      for (int d = 0; d < Dim; ++d) average[d] += multipliers[k].tangents[t][d] * dual;
    }
  }
  for (std::size_t p = 0; p < arrays.num_periods; ++p) {
    const Scalar* field = arrays.period_fields + (p * arrays.num_cells + cell) * Dim;
    const P dual = load_pack<lanes>(arrays.period_dual + p * stride + i);
    for (int d = 0; d < Dim; ++d) average[d] += field[d] * dual;
  }
  for (int d = 0; d < Dim; ++d) {
    const P gradient = load_pack<lanes>(arrays.gradient + row + d * stride);
    average[d] = gradient + arrays.inverse_M * average[d];
  }
}

// Q^T r of (8) by control points, as Dim x (Dim + 1) packs to be summed over their lanes; in
// eights.
template <int Dim>
constexpr int kProjections = Dim*(Dim + 1);
template <int Dim>
constexpr int kProjectionEights = (kProjections<Dim> + kLanes - 1) / kLanes;

template <class Scalar, int Dim, int lanes>
[[gnu::always_inline]] inline void add_projection(const Arrays<Scalar, Dim>& arrays, std::size_t i,
                                                  const PackN<Scalar, lanes>* average,
                                                  PackN<Scalar, lanes>* projection) {
  for (int k = 0; k <= Dim; ++k) {
    const auto q = load_pack<lanes>(arrays.basis + k * arrays.stride + i);
    for (int d = 0; d < Dim; ++d) projection[d * (Dim + 1) + k] += q * average[d];
  }
}

// Squared changes made by the G-step.
template <class Scalar, bool note>
struct GradientChange {
  SquareSum<Scalar, note> gradient;
  SquareSum<Scalar, note> lead;
  double removed = 0;  // from the lead, by the projection
};

// First half of the G-step: stores the average in `extrapolated` and the violation of (8), r Q -
// target, in `excess`.
template <bool note, class Scalar, int Dim>
[[gnu::always_inline]] inline void average_cell(const Arrays<Scalar, Dim>& arrays,
                                                std::int32_t cell, Scalar* extrapolated,
                                                Scalar* excess,
                                                GradientChange<Scalar, note>& change) {
  const std::size_t stride = arrays.stride;
  FacetMultiplier<Scalar, Dim> multipliers[Dim + 1];
  gather_facets(arrays, cell, multipliers);
  const auto average = [&](auto lanes, std::size_t i,
                           PackN<Scalar, decltype(lanes)::value>* projection)
      __attribute__((always_inline)) {
    PackN<Scalar, lanes()> r[Dim];
    average_candidates<lanes()>(arrays, cell, multipliers, i, r);
    add_projection<Scalar, Dim, lanes()>(arrays, i, r, projection);
    for (int d = 0; d < Dim; ++d) {
      Scalar* place = extrapolated + d * stride + i;
      // The residual needs only the distance of the old extrapolation from r, because the
      // projection changes r orthogonally to every difference of gradients.
      if constexpr (note) change.lead.template add<lanes()>(load_pack<lanes()>(place) - r[d]);
      store_pack<lanes()>(place, r[d]);
    }
  };

  // Explicit, because a loop or an array initialization would spill them to memory.
  Pack<Scalar> projection[kProjectionEights<Dim> * kLanes];
  std::size_t i = 0;
  if constexpr (constexpr std::integral_constant<int, kWide<Scalar>> lanes{}; lanes() > kLanes) {
    PackN<Scalar, lanes()> wide[kProjections<Dim>];
#pragma GCC unroll 16
    for (auto& pack : wide) pack = PackN<Scalar, lanes()>{};
    for (; i + lanes() <= stride; i += lanes()) average(lanes, i, wide);
#pragma GCC unroll 16
    for (int k = 0; k < kProjections<Dim>; ++k) projection[k] = fold<Scalar>(wide[k]);
  } else {
#pragma GCC unroll 16
    for (int k = 0; k < kProjections<Dim>; ++k) projection[k] = Pack<Scalar>{};
  }
#pragma GCC unroll 16
  for (int k = kProjections<Dim>; k < kProjectionEights<Dim> * kLanes; ++k) {
    projection[k] = Pack<Scalar>{};
  }
  for (; i < stride; i += kLanes) average(std::integral_constant<int, kLanes>{}, i, projection);

#pragma GCC unroll 2
  for (int eight = 0; eight < kProjectionEights<Dim>; ++eight) {
    const Pack<Scalar> rest = sum_each<Scalar>(projection + eight * kLanes) -
                              load_pack<kLanes>(arrays.target + eight * kLanes);
    store_pack<kLanes>(excess + eight * kLanes, rest);
    if constexpr (note) change.removed += sum<Scalar>(rest * rest);
  }
}

// The G-step: projects the average onto (8) as r - (r Q - target) Q^T, and with `then_tv` performs
// the Z-step of the next iteration. \param extrapolated  output; its old value is needed to record
// the lead. \return the changes; of the dual only with `then_tv`
template <bool note_gradient, bool then_tv, bool note_tv, class Scalar, int Dim>
inline Change g_step_at(const Arrays<Scalar, Dim>& arrays, std::int32_t cell,
                        Scalar* extrapolated) {
  const std::size_t stride = arrays.stride;
  Scalar* gradient = arrays.gradient + std::size_t(cell) * Dim * stride;
  GradientChange<Scalar, note_gradient> change;
  SquareSum<Scalar, note_tv> dual_change;
  alignas(64) Scalar excess[kProjectionEights<Dim> * kLanes];
  average_cell(arrays, cell, extrapolated, excess, change);
  for_packs<kWide<Scalar>>(
      0, stride, [&](auto lanes, std::size_t i) __attribute__((always_inline)) {
        using P = PackN<Scalar, lanes()>;
        P q[Dim + 1];
        P e[Dim];
        for (int k = 0; k <= Dim; ++k) q[k] = load_pack<lanes()>(arrays.basis + k * stride + i);
        for (int d = 0; d < Dim; ++d) {
          P projected = load_pack<lanes()>(extrapolated + d * stride + i);
          for (int k = 0; k <= Dim; ++k) projected -= excess[d * (Dim + 1) + k] * q[k];
          const P old = load_pack<lanes()>(gradient + d * stride + i);
          const P step = projected - old;
          e[d] = projected + step;
          store_pack<lanes()>(extrapolated + d * stride + i, e[d]);
          store_pack<lanes()>(gradient + d * stride + i, old + arrays.relaxation * step);
          change.gradient.template add<lanes()>(step);
        }
        if constexpr (then_tv) z_step_at<lanes()>(arrays, cell, i, e, dual_change);
      });
  Change result;
  if constexpr (note_tv) result.dual = dual_change.total();
  if constexpr (note_gradient) {
    result.gradient = change.gradient.total();
    result.lead = change.lead.total() - change.removed;
  }
  return result;
}
