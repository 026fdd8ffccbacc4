// SPDX-License-Identifier: BSD-3-Clause
// Where the splitting on the weights starts from.
#include <algorithm>

#include "mesh/cell_geometry.h"
#include "solver/splitting/weight_splitting.h"

namespace flbc::splitting {

template <class Scalar, int Dim>
void WeightSplitting<Scalar, Dim>::resume() {
  WeightMatrix row(n_, 1);
  for (std::size_t b = 0; b < problem_.boundary.vertices.size(); ++b) {
    row.setZero();
    problem_.boundary.scatter(static_cast<Index>(b), row.col(0));
    Scalar* weights = weights_.data() + problem_.boundary.vertices[b] * stride_;
    for (Index i = 0; i < n_; ++i) weights[i] = static_cast<Scalar>(row(i, 0));
  }
}

template <class Scalar, int Dim>
void WeightSplitting<Scalar, Dim>::set_weights(const WeightMatrix& weights) {
#pragma omp parallel for schedule(static)
  for (Index v = 0; v < problem_.mesh.num_vertices(); ++v) {
    for (Index i = 0; i < n_; ++i) weights_[v * stride_ + i] = static_cast<Scalar>(weights(i, v));
  }
}

template <class Scalar, int Dim>
void WeightSplitting<Scalar, Dim>::start_from_weights(const WeightMatrix& weights) {
  set_weights(weights);
  std::fill_n(cell_state_.data(), cell_state_.size(), Scalar(0));
  std::copy_n(weights_.data(), vertex_state_.size(), vertex_state_.data());
}

template <class Scalar, int Dim>
void WeightSplitting<Scalar, Dim>::start_without_duals(const WeightMatrix& weights) {
  using Flux = Eigen::Matrix<double, Eigen::Dynamic, Dim>;
  set_weights(weights);
  set_states([this](Index) -> Flux { return Flux::Zero(n_, Dim); }, {});
}

// A Y-step alone, for the states there are. \return squared change of the weights
template <class Scalar, int Dim>
double WeightSplitting<Scalar, Dim>::correct_weights() {
  return run([&](Arrays<Scalar, Dim> state, Columns columns) {
    state.relaxation = 0;  // the states stay
    kernel_.w_step(state, columns);
    kernel_.z_step(state, columns);
  });
}

// With y = 0 the right-hand side is -Div m grad w + k (q - w), which without k is solved by the
// minimiser of sum m |grad w|^2. With q = w it is solved by (K + k) w' = k w, where K w = 0 is the
// minimiser's equation: each step takes it nearer.
template <class Scalar, int Dim>
void WeightSplitting<Scalar, Dim>::start_from_harmonic(int steps) {
  constexpr double kStands = 1e-9;  // mean squared change, far below what the iteration moves
  start_from_weights(WeightMatrix::Zero(n_, problem_.mesh.num_vertices()));
  resume();
  const double stands = kStands * static_cast<double>(data_.vertices.size()) * n_;
  bool moves = true;
  for (int step = 0; step < steps && moves; ++step) {
    moves = correct_weights() > stands;
    std::copy_n(weights_.data(), vertex_state_.size(), vertex_state_.data());
  }
}

// For states y = grad w - p / (rho m) and q = w + dual a Y-step would find a correction d. States
// that are lower by grad d and d have the right-hand side -K d in addition: they leave w alone.
template <class Scalar, int Dim>
void WeightSplitting<Scalar, Dim>::start_from_duals(const WeightMatrix& weights,
                                                    const VectorsAt<Dim>& flux_density,
                                                    const WeightMatrix& vertex_dual) {
  set_weights(weights);
  set_states(flux_density, vertex_dual);
  correct_weights();
  take_back_correction();
  set_weights(weights);
}

// Calls body(begin, width, row) for the slices of a component of a cell's state, without padding.
template <class Scalar, int Dim>
template <class Body>
void WeightSplitting<Scalar, Dim>::for_cell_row(Index cell, int component, const Body& body) {
  const auto rows = static_cast<std::size_t>(problem_.mesh.num_cells()) * Dim;
  slices_.for_each(static_cast<std::size_t>(cell) * Dim + component, rows,
                        [&](std::size_t begin, std::size_t width, std::size_t place) {
                          const auto first = static_cast<Index>(begin);
                          const Index own = std::min(static_cast<Index>(width), n_ - first);
                          if (own > 0) {
                            body(first, own, StateRow(cell_state_.data() + place, own));
                          }
                        });
}

template <class Scalar, int Dim>
void WeightSplitting<Scalar, Dim>::set_states(const VectorsAt<Dim>& flux_density,
                                              const WeightMatrix& vertex_dual) {
#pragma omp parallel for schedule(static)
  for (Index s = 0; s < problem_.mesh.num_cells(); ++s) {
    const auto geometry = cell_geometry(problem_.mesh, s);
    Eigen::Matrix<double, Eigen::Dynamic, Dim> state =
        flux_density(s) * (-geometry.measure / (penalty_ * metric_.cell[s]));
    for (int k = 0; k <= Dim; ++k) {
      const Scalar* corner = weights_.data() + problem_.mesh.cells(k, s) * stride_;
      for (Index i = 0; i < n_; ++i) {
        state.row(i) += static_cast<double>(corner[i]) * geometry.hat_gradients.col(k).transpose();
      }
    }
    for (int d = 0; d < Dim; ++d) {
      for_cell_row(s, d, [&](Index begin, Index width, StateRow row) {
        row = state.col(d).segment(begin, width).template cast<Scalar>();
      });
    }
  }
  std::copy_n(weights_.data(), vertex_state_.size(), vertex_state_.data());
  if (vertex_state_.size() == 0 || vertex_dual.size() == 0) return;
  for (const Index v : data_.vertices) {
    for (Index i = 0; i < n_; ++i) {
      vertex_state_[v * stride_ + i] += static_cast<Scalar>(vertex_dual(i, v));
    }
  }
}

// y -= grad d and q -= d for the correction d that the last Y-step left, zero on the boundary.
template <class Scalar, int Dim>
void WeightSplitting<Scalar, Dim>::take_back_correction() {
  using Row = Eigen::Map<const Eigen::Matrix<Scalar, Eigen::Dynamic, 1>>;
  const std::size_t boundary_row = data_.vertices.size() * stride_;
  std::fill_n(residual_.data() + boundary_row, stride_, Scalar(0));
  const auto correction = [&](Index row) { return Row(residual_.data() + row * stride_, n_); };
#pragma omp parallel for schedule(static)
  for (Index s = 0; s < problem_.mesh.num_cells(); ++s) {
    const auto hats = cell_geometry(problem_.mesh, s).hat_gradients;
    for (int k = 0; k <= Dim; ++k) {
      const auto d = correction(data_.cell_rows[static_cast<std::size_t>(s) * (Dim + 1) + k]);
      for (int c = 0; c < Dim; ++c) {
        for_cell_row(s, c, [&](Index begin, Index width, StateRow row) {
          row -= static_cast<Scalar>(hats(c, k)) * d.segment(begin, width);
        });
      }
    }
  }
  if (vertex_state_.size() == 0) return;
  for (std::size_t row = 0; row < data_.vertices.size(); ++row) {
    StateRow(vertex_state_.data() + data_.vertices[row] * stride_, n_) -=
        correction(static_cast<Index>(row));
  }
}

#define FLBC_INSTANTIATE(Scalar, Dim)                                                   \
  template void WeightSplitting<Scalar, Dim>::resume();                                 \
  template void WeightSplitting<Scalar, Dim>::start_from_weights(const WeightMatrix&);  \
  template void WeightSplitting<Scalar, Dim>::start_without_duals(const WeightMatrix&); \
  template void WeightSplitting<Scalar, Dim>::start_from_harmonic(int);                 \
  template void WeightSplitting<Scalar, Dim>::start_from_duals(                         \
      const WeightMatrix&, const VectorsAt<Dim>&, const WeightMatrix&);
FLBC_INSTANTIATE(float, 2)
FLBC_INSTANTIATE(float, 3)
FLBC_INSTANTIATE(double, 2)
FLBC_INSTANTIATE(double, 3)
#undef FLBC_INSTANTIATE

}  // namespace flbc::splitting
