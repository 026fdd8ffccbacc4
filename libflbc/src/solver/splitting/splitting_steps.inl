// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! The steps of an iteration for one cell, vertex or row. Included by splitting_kernel.inl within
//! its namespace of the instruction set.

// One cell, as the loop over control points sees it.
template <class Scalar, int Dim>
struct Cell {
  const Scalar* weights[Dim + 1];
  Scalar* residual[Dim + 1];
  Scalar* state;
  const Scalar* phi;
  Scalar hat_gradients[Dim][Dim];  // of the corners 1 .. Dim; corner 0 has minus their sum
  Scalar metric;
  Scalar radius_scale;
};

template <class Scalar, int Dim>
inline Cell<Scalar, Dim> gather_cell(const Arrays<Scalar, Dim>& arrays, std::size_t s) {
  Cell<Scalar, Dim> cell;
  for (int k = 0; k <= Dim; ++k) {
    const std::size_t corner = s * (Dim + 1) + k;
    cell.weights[k] = arrays.weights + std::size_t(arrays.cells[corner]) * arrays.stride;
    cell.residual[k] = arrays.residual + std::size_t(arrays.cell_rows[corner]) * arrays.stride;
  }
  cell.state = arrays.cell_state + s * Dim * arrays.cell_stride;
  cell.phi = arrays.phi + s * arrays.cell_stride;
  for (int k = 0; k < Dim; ++k) {
    for (int d = 0; d < Dim; ++d) {
      cell.hat_gradients[k][d] = arrays.hat_gradients[(s * Dim + k) * Dim + d];
    }
  }
  cell.metric = arrays.cell_metric[s];
  cell.radius_scale = arrays.radius_scale[s];
  return cell;
}

// x = grad w.
template <class Scalar, int Dim, int Lanes>
inline void weight_gradient(const Cell<Scalar, Dim>& cell, std::size_t i,
                            PackN<Scalar, Lanes>* gradient) {
  const auto first = load_pack<Lanes>(cell.weights[0] + i);
  for (int d = 0; d < Dim; ++d) gradient[d] = PackN<Scalar, Lanes>{};
  for (int k = 0; k < Dim; ++k) {
    const auto difference = load_pack<Lanes>(cell.weights[k + 1] + i) - first;
    for (int d = 0; d < Dim; ++d) gradient[d] += cell.hat_gradients[k][d] * difference;
  }
}

// p = 2 x - y, projected on the ball of radius phi A / (rho m).
template <class Scalar, int Dim, int Lanes>
inline void clip(const Cell<Scalar, Dim>& cell, std::size_t i, const PackN<Scalar, Lanes>* gradient,
                 const PackN<Scalar, Lanes>* state, PackN<Scalar, Lanes>* clipped) {
  const auto radius = cell.radius_scale * load_pack<Lanes>(cell.phi + i);
  auto norm2 = radius * radius + std::numeric_limits<Scalar>::min();
  PackN<Scalar, Lanes> length2{};
  for (int d = 0; d < Dim; ++d) {
    clipped[d] = Scalar(2) * gradient[d] - state[d];
    length2 += clipped[d] * clipped[d];
  }
  norm2 = length2 > norm2 ? length2 : norm2;
  const PackN<Scalar, Lanes> shrink = radius * inverse_square_root<Scalar, Lanes>(norm2);
  for (int d = 0; d < Dim; ++d) clipped[d] *= shrink;
}

// Adds the divergence of m (y - x): what the weights' correction has to balance.
template <class Scalar, int Dim, int Lanes>
inline void scatter_divergence(const Cell<Scalar, Dim>& cell, std::size_t i,
                               const PackN<Scalar, Lanes>* field) {
  PackN<Scalar, Lanes> sum{};
  for (int k = 0; k < Dim; ++k) {
    PackN<Scalar, Lanes> share = cell.hat_gradients[k][0] * field[0];
    for (int d = 1; d < Dim; ++d) share += cell.hat_gradients[k][d] * field[d];
    sum += share;
    Scalar* row = cell.residual[k + 1] + i;
    store_pack<Lanes>(row, load_pack<Lanes>(row) + share);
  }
  Scalar* row = cell.residual[0] + i;
  store_pack<Lanes>(row, load_pack<Lanes>(row) - sum);
}

// Z-step and dual step: y += relaxation (x - y - p).
template <class Scalar, int Dim, bool Measured, int Lanes>
inline void z_step_at(const Arrays<Scalar, Dim>& arrays, const Cell<Scalar, Dim>& cell,
                      std::size_t i) {
  using Numbers = PackN<Scalar, Lanes>;
  Numbers x[Dim];
  Numbers y[Dim];
  Numbers p[Dim];
  weight_gradient<Scalar, Dim, Lanes>(cell, i, x);
  for (int d = 0; d < Dim; ++d) y[d] = load_pack<Lanes>(cell.state + d * arrays.cell_stride + i);
  clip<Scalar, Dim, Lanes>(cell, i, x, y, p);
  Numbers violation{};
  for (int d = 0; d < Dim; ++d) {
    const Numbers step = x[d] - y[d] - p[d];
    if constexpr (Measured) violation += step * step;
    y[d] += arrays.relaxation * step;
    store_pack<Lanes>(cell.state + d * arrays.cell_stride + i, y[d]);
    y[d] = cell.metric * (y[d] - x[d]);
  }
  if constexpr (Measured) {
    Scalar* sum = arrays.violation_sum + i;
    store_pack<Lanes>(sum, load_pack<Lanes>(sum) + cell.metric * violation);
  }
  scatter_divergence<Scalar, Dim, Lanes>(cell, i, y);
}

// W-step and dual step: u = 2 w - q, at least 0 and at most the largest weight,
// q += relaxation (u - w).
template <class Scalar, int Dim, bool Measured, int Lanes>
inline void w_step_at(const Arrays<Scalar, Dim>& arrays, std::size_t row, std::size_t i) {
  using Numbers = PackN<Scalar, Lanes>;
  const Scalar metric = arrays.vertex_metric[row];
  const std::size_t vertex = std::size_t(arrays.vertices[row]) * arrays.stride + i;
  Scalar* state = arrays.vertex_state + vertex;
  const Numbers w = load_pack<Lanes>(arrays.weights + vertex);
  Numbers q = load_pack<Lanes>(state);
  const Numbers most = Numbers{} + arrays.largest_weight;
  Numbers copy = Scalar(2) * w - q;
  copy = copy > Numbers{} ? copy : Numbers{};
  const Numbers step = (copy < most ? copy : most) - w;
  q += arrays.relaxation * step;
  store_pack<Lanes>(state, q);
  store_pack<Lanes>(arrays.residual + row * arrays.stride + i, metric * (q - w));
  if constexpr (Measured) {
    Scalar* sum = arrays.violation_sum + i;
    store_pack<Lanes>(sum, load_pack<Lanes>(sum) + metric * step * step);
  }
}

// The corrected row r = w + delta, projected on { sum w = 1, sum w c = x }: the Laplacian acts on
// columns and this on rows, so doing one after the other solves for both exactly. The change of
// the weights is left where the correction was.
template <class Scalar, int Dim>
double y_step_at(const Arrays<Scalar, Dim>& arrays, std::size_t row) {
  constexpr int kLanes = kRowLanes;
  using Numbers = PackN<Scalar, kLanes>;
  Scalar* weights = arrays.weights + std::size_t(arrays.vertices[row]) * arrays.stride;
  Scalar* corrected = arrays.residual + row * arrays.stride;
  Numbers projection[Dim + 1] = {};
  for (std::size_t i = 0; i < arrays.stride; i += kLanes) {
    const Numbers r = load_pack<kLanes>(weights + i) + load_pack<kLanes>(corrected + i);
    store_pack<kLanes>(corrected + i, r);
    for (int k = 0; k <= Dim; ++k) {
      projection[k] += load_pack<kLanes>(arrays.basis + k * arrays.stride + i) * r;
    }
  }
  Scalar excess[Dim + 1];
  for (int k = 0; k <= Dim; ++k) {
    Scalar sum = 0;
    for (int l = 0; l < kLanes; ++l) sum += projection[k][l];
    excess[k] = sum - arrays.row_target[row * (Dim + 1) + k];
  }
  Numbers change{};
  for (std::size_t i = 0; i < arrays.stride; i += kLanes) {
    Numbers projected = load_pack<kLanes>(corrected + i);
    for (int k = 0; k <= Dim; ++k) {
      projected -= excess[k] * load_pack<kLanes>(arrays.basis + k * arrays.stride + i);
    }
    const Numbers step = projected - load_pack<kLanes>(weights + i);
    store_pack<kLanes>(weights + i, projected);
    store_pack<kLanes>(corrected + i, step);
    change += step * step;
  }
  double total = 0;
  for (int l = 0; l < kLanes; ++l) total += static_cast<double>(change[l]);
  return total;
}
