// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! The loops, included once per instruction set with FLBC_ISA as its name. Each including file is
//! compiled with the flags of that set (see libflbc/CMakeLists.txt).
#include <limits>

#include "gradient/gradient_kernel.h"
#include "pack.h"

namespace flbc::gradient::FLBC_ISA {
namespace {

static_assert(kLanes == kRowLanes);

template <class Scalar>
using Pack = PackN<Scalar, kLanes>;

template <class Scalar>
inline Pack<Scalar> load(const Scalar* from) {
  return load_pack<kLanes>(from);
}

template <class Scalar>
inline void store(Scalar* to, Pack<Scalar> value) {
  store_pack<kLanes>(to, value);
}

template <class Scalar>
inline double sum(Pack<Scalar> pack) {
  double total = 0;
  for (int l = 0; l < kLanes; ++l) total += static_cast<double>(pack[l]);
  return total;
}

// (9): the boundary facet's dual grows by the violation of t . g = h.
template <class Scalar, int Dim>
double update_boundary_dual(const Arrays<Scalar, Dim>& arrays, std::int32_t facet) {
  constexpr int kTangents = Dim - 1;
  const std::size_t stride = arrays.stride;
  const Scalar* inner = arrays.extrapolated + std::size_t(arrays.sides[2 * facet]) * Dim * stride;
  const Scalar* slope =
      arrays.boundary_slope + std::size_t(arrays.boundary_slot[facet]) * kTangents * stride;
  const Scalar* tangents = arrays.tangents + std::size_t(facet) * kTangents * Dim;
  Scalar* dual = arrays.facet_dual + std::size_t(facet) * kTangents * stride;
  Pack<Scalar> change{};
  for (int t = 0; t < kTangents; ++t) {
    for (std::size_t i = 0; i < stride; i += kLanes) {
      Pack<Scalar> step = load(slope + t * stride + i);
      for (int d = 0; d < Dim; ++d) step -= tangents[t * Dim + d] * load(inner + d * stride + i);
      store(dual + t * stride + i, load(dual + t * stride + i) + arrays.relaxation * step);
      change += step * step;
    }
  }
  return sum<Scalar>(change);
}

// (10): the interior facet's dual grows by half the jump of the tangential gradient.
template <class Scalar, int Dim>
double update_interior_dual(const Arrays<Scalar, Dim>& arrays, std::int32_t facet) {
  constexpr int kTangents = Dim - 1;
  const std::size_t stride = arrays.stride;
  const Scalar* first = arrays.extrapolated + std::size_t(arrays.sides[2 * facet]) * Dim * stride;
  const Scalar* second =
      arrays.extrapolated + std::size_t(arrays.sides[2 * facet + 1]) * Dim * stride;
  const Scalar* tangents = arrays.tangents + std::size_t(facet) * kTangents * Dim;
  Scalar* dual = arrays.facet_dual + std::size_t(facet) * kTangents * stride;
  Pack<Scalar> change{};
  for (std::size_t i = 0; i < stride; i += kLanes) {
    Pack<Scalar> half_jump[Dim];
    for (int d = 0; d < Dim; ++d) {
      half_jump[d] = Scalar(0.5) * (load(second + d * stride + i) - load(first + d * stride + i));
    }
    for (int t = 0; t < kTangents; ++t) {
      Pack<Scalar> step{};
      for (int d = 0; d < Dim; ++d) step += tangents[t * Dim + d] * half_jump[d];
      store(dual + t * stride + i, load(dual + t * stride + i) + arrays.relaxation * step);
      change += step * step;
    }
  }
  return 2 * sum<Scalar>(change);
}

// Z-step: the dual of Z = G is minus the projection of `extrapolated - dual` on the ball of radius
// phi A / mu. Returns the squared change.
template <class Scalar, int Dim>
inline Pack<Scalar> update_tv_dual(Pack<Scalar> radius, const Pack<Scalar>* extrapolated,
                                   Scalar relaxation, Pack<Scalar>* dual) {
  Pack<Scalar> norm2 = radius * radius + std::numeric_limits<Scalar>::min();
  Pack<Scalar> length2{};
  for (int d = 0; d < Dim; ++d) {
    const Pack<Scalar> v = extrapolated[d] - dual[d];
    length2 += v * v;
  }
  norm2 = length2 > norm2 ? length2 : norm2;
  const Pack<Scalar> shrink = radius * inverse_square_root<Scalar, kLanes>(norm2);
  Pack<Scalar> change{};
  for (int d = 0; d < Dim; ++d) {
    const Pack<Scalar> step = shrink * (dual[d] - extrapolated[d]) - dual[d];
    dual[d] += relaxation * step;
    change += step * step;
  }
  return change;
}

// One facet of a cell, as the cell sees it: the dual's direction in space, signed for its side.
template <class Scalar, int Dim>
struct FacetPull {
  const Scalar* dual;
  Scalar tangents[Dim - 1][Dim];
};

template <class Scalar, int Dim>
inline void gather_facets(const Arrays<Scalar, Dim>& arrays, std::int32_t cell,
                          FacetPull<Scalar, Dim>* pulls) {
  for (int k = 0; k <= Dim; ++k) {
    const std::int32_t facet = arrays.cell_facets[std::size_t(cell) * (Dim + 1) + k];
    const Scalar sign = arrays.sides[2 * facet] == cell ? Scalar(1) : Scalar(-1);
    pulls[k].dual = arrays.facet_dual + std::size_t(facet) * (Dim - 1) * arrays.stride;
    for (int t = 0; t < Dim - 1; ++t) {
      for (int d = 0; d < Dim; ++d) {
        pulls[k].tangents[t][d] =
            sign * arrays.tangents[(std::size_t(facet) * (Dim - 1) + t) * Dim + d];
      }
    }
  }
}

// Average of all candidates for the cell's gradient, r_s of (11): g + (sum of its duals) / M.
template <class Scalar, int Dim>
inline void average_candidates(const Arrays<Scalar, Dim>& arrays, std::int32_t cell,
                               const FacetPull<Scalar, Dim>* pulls, std::size_t i,
                               const Pack<Scalar>* gradient, const Pack<Scalar>* tv_dual,
                               Pack<Scalar>* average) {
  const std::size_t stride = arrays.stride;
  for (int d = 0; d < Dim; ++d) average[d] = tv_dual[d];
  for (int k = 0; k <= Dim; ++k) {
    for (int t = 0; t < Dim - 1; ++t) {
      const Pack<Scalar> dual = load(pulls[k].dual + t * stride + i);
      for (int d = 0; d < Dim; ++d) average[d] += pulls[k].tangents[t][d] * dual;
    }
  }
  for (std::size_t p = 0; p < arrays.num_periods; ++p) {
    const Scalar* field = arrays.period_fields + (p * arrays.num_cells + cell) * Dim;
    const Pack<Scalar> dual = load(arrays.period_dual + p * stride + i);
    for (int d = 0; d < Dim; ++d) average[d] += field[d] * dual;
  }
  for (int d = 0; d < Dim; ++d) average[d] = gradient[d] + arrays.inverse_copies * average[d];
}

// The Z-step, then the G-step: the average projected on (8) as r - (r Q - target) Q^T.
template <class Scalar, int Dim>
Change update_cell(const Arrays<Scalar, Dim>& arrays, std::int32_t cell) {
  const std::size_t stride = arrays.stride;
  Scalar* gradient = arrays.gradient + std::size_t(cell) * Dim * stride;
  Scalar* extrapolated = arrays.extrapolated + std::size_t(cell) * Dim * stride;
  Scalar* tv_dual = arrays.tv_dual + std::size_t(cell) * Dim * stride;
  const Scalar* radius = arrays.radius + std::size_t(cell) * stride;
  FacetPull<Scalar, Dim> pulls[Dim + 1];
  gather_facets(arrays, cell, pulls);

  Pack<Scalar> dual_change{};
  Pack<Scalar> lead_change{};
  Pack<Scalar> projection[Dim][Dim + 1] = {};
  for (std::size_t i = 0; i < stride; i += kLanes) {
    Pack<Scalar> g[Dim];
    Pack<Scalar> e[Dim];
    Pack<Scalar> u[Dim];
    Pack<Scalar> r[Dim];
    for (int d = 0; d < Dim; ++d) {
      g[d] = load(gradient + d * stride + i);
      e[d] = load(extrapolated + d * stride + i);
      u[d] = load(tv_dual + d * stride + i);
    }
    dual_change += update_tv_dual<Scalar, Dim>(load(radius + i), e, arrays.relaxation, u);
    average_candidates<Scalar, Dim>(arrays, cell, pulls, i, g, u, r);
    for (int k = 0; k <= Dim; ++k) {
      const Pack<Scalar> q = load(arrays.basis + k * stride + i);
      for (int d = 0; d < Dim; ++d) projection[d][k] += q * r[d];
    }
    for (int d = 0; d < Dim; ++d) {
      store(tv_dual + d * stride + i, u[d]);
      // The old extrapolation is needed once more, for the residual, but only its distance from r:
      // what the projection takes away from r is orthogonal to every difference of gradients.
      const Pack<Scalar> lead = e[d] - r[d];
      lead_change += lead * lead;
      store(extrapolated + d * stride + i, r[d]);
    }
  }

  Scalar excess[Dim][Dim + 1];
  double removed = 0;
  for (int d = 0; d < Dim; ++d) {
    for (int k = 0; k <= Dim; ++k) {
      const double value =
          sum<Scalar>(projection[d][k]) - static_cast<double>(arrays.target[d * (Dim + 1) + k]);
      excess[d][k] = static_cast<Scalar>(value);
      removed += value * value;
    }
  }

  Pack<Scalar> gradient_change{};
  for (std::size_t i = 0; i < stride; i += kLanes) {
    Pack<Scalar> q[Dim + 1];
    for (int k = 0; k <= Dim; ++k) q[k] = load(arrays.basis + k * stride + i);
    for (int d = 0; d < Dim; ++d) {
      Pack<Scalar> projected = load(extrapolated + d * stride + i);
      for (int k = 0; k <= Dim; ++k) projected -= excess[d][k] * q[k];
      const Pack<Scalar> old = load(gradient + d * stride + i);
      const Pack<Scalar> step = projected - old;
      store(extrapolated + d * stride + i, projected + step);
      store(gradient + d * stride + i, old + arrays.relaxation * step);
      gradient_change += step * step;
    }
  }

  Change change;
  change.dual = sum<Scalar>(dual_change);
  change.gradient = sum<Scalar>(gradient_change);
  change.lead = sum<Scalar>(lead_change) - removed;
  return change;
}

template <class Scalar, int Dim>
Change update_facets(const Arrays<Scalar, Dim>& arrays, std::int32_t begin, std::int32_t end) {
  Change change;
  for (std::int32_t facet = begin; facet < end; ++facet) {
    change.dual += arrays.sides[2 * facet + 1] < 0 ? update_boundary_dual(arrays, facet)
                                                   : update_interior_dual(arrays, facet);
  }
  return change;
}

template <class Scalar, int Dim>
Change update_cells(const Arrays<Scalar, Dim>& arrays, std::int32_t begin, std::int32_t end) {
  Change change;
  for (std::int32_t cell = begin; cell < end; ++cell) change += update_cell(arrays, cell);
  return change;
}

template <class Scalar, int Dim>
constexpr Kernel<Scalar, Dim> kKernel{update_facets<Scalar, Dim>, update_cells<Scalar, Dim>};

}  // namespace

extern const Kernel<float, 2> kFloat2 = kKernel<float, 2>;
extern const Kernel<float, 3> kFloat3 = kKernel<float, 3>;
extern const Kernel<double, 2> kDouble2 = kKernel<double, 2>;
extern const Kernel<double, 3> kDouble3 = kKernel<double, 3>;

}  // namespace flbc::gradient::FLBC_ISA
