// SPDX-License-Identifier: BSD-3-Clause
// Where the splitting on the weights starts from.
#include <algorithm>

#include "mesh/cell_geometry.h"
#include "solver/splitting/weight_splitting.h"

namespace flbc::splitting {

template <class Scalar, int Dim>
void WeightSplitting<Scalar, Dim>::start_from_weights(const WeightMatrix& weights) {
  for (Index v = 0; v < problem_.mesh.num_vertices(); ++v) {
    for (Index i = 0; i < n_; ++i) weights_[v * stride_ + i] = static_cast<Scalar>(weights(i, v));
  }
  std::copy_n(weights_.data(), vertex_state_.size(), vertex_state_.data());
  std::fill_n(cell_state_.data(), cell_state_.size(), Scalar(0));
}

// Solves for the weights without taking a step: states stay as they are. \return squared change
template <class Scalar, int Dim>
double WeightSplitting<Scalar, Dim>::solve_for_weights() {
  return run([&](Arrays<Scalar, Dim> state, Columns columns) {
    state.relaxation = 0;
    kernel_.w_step(state, columns);
    kernel_.z_step(state, columns);
  });
}

// With y = 0 and q = w the right-hand side is minus the gradient of sum m |grad w|^2 / 2.
template <class Scalar, int Dim>
void WeightSplitting<Scalar, Dim>::start_from_harmonic(int steps) {
  constexpr double kSmallChange = 1e-9;  // mean squared
  const double numbers = static_cast<double>(data_.vertices.size()) * n_;
  start_from_weights(WeightMatrix::Zero(n_, problem_.mesh.num_vertices()));
  resume();
  for (int step = 0; step < steps; ++step) {
    const double change = solve_for_weights();
    std::copy_n(weights_.data(), vertex_state_.size(), vertex_state_.data());
    if (change <= kSmallChange * numbers) return;
  }
}

// Every iteration leaves states whose right-hand side moves no weight. Duals from elsewhere would
// move them by d; y = grad (w - d) - p / (rho m) and q = w - d + dual do not.
template <class Scalar, int Dim>
void WeightSplitting<Scalar, Dim>::start_from_duals(const WeightMatrix& weights,
                                                    const VectorsAt<Dim>& flux_density,
                                                    const WeightMatrix& vertex_dual) {
  start_from_weights(weights);
  set_states(flux_density, vertex_dual);
  solve_for_weights();
  for (std::size_t row = 0; row < data_.vertices.size(); ++row) {
    Scalar* moved = weights_.data() + data_.vertices[row] * stride_;
    for (std::size_t i = 0; i < stride_; ++i) moved[i] -= 2 * residual_[row * stride_ + i];
  }
  set_states(flux_density, vertex_dual);
  for (const Index v : data_.vertices) {
    for (Index i = 0; i < n_; ++i) weights_[v * stride_ + i] = static_cast<Scalar>(weights(i, v));
  }
}

// y = grad w - p / (rho m) and q = w + dual.
template <class Scalar, int Dim>
void WeightSplitting<Scalar, Dim>::set_states(const VectorsAt<Dim>& flux_density,
                                              const WeightMatrix& vertex_dual) {
  const Index cells = problem_.mesh.num_cells();
#pragma omp parallel for schedule(static)
  for (Index s = 0; s < cells; ++s) {
    const auto geometry = cell_geometry(problem_.mesh, s);
    Eigen::Matrix<double, Eigen::Dynamic, Dim> state =
        -geometry.measure / (penalty_ * metric_.cell[s]) * flux_density(s);
    for (int k = 0; k <= Dim; ++k) {
      const Scalar* corner = weights_.data() + problem_.mesh.cells(k, s) * stride_;
      state += Eigen::Map<const Eigen::Matrix<Scalar, Eigen::Dynamic, 1>>(corner, n_)
                   .template cast<double>() *
               geometry.hat_gradients.col(k).transpose();
    }
    for (int d = 0; d < Dim; ++d) {
      Scalar* row = cell_state_.data() + (static_cast<std::size_t>(s) * Dim + d) * stride_;
      for (Index i = 0; i < n_; ++i) row[i] = static_cast<Scalar>(state(i, d));
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

template <class Scalar, int Dim>
void WeightSplitting<Scalar, Dim>::resume() {
  Eigen::VectorXd row(n_);
  for (std::size_t b = 0; b < problem_.boundary.vertices.size(); ++b) {
    row.setZero();
    problem_.boundary.scatter(static_cast<Index>(b), row);
    Scalar* weights = weights_.data() + problem_.boundary.vertices[b] * stride_;
    for (Index i = 0; i < n_; ++i) weights[i] = static_cast<Scalar>(row[i]);
  }
}

#define FLBC_INSTANTIATE(Scalar, Dim)                                                     \
  template void WeightSplitting<Scalar, Dim>::start_from_weights(const WeightMatrix&);    \
  template void WeightSplitting<Scalar, Dim>::start_from_harmonic(int);                   \
  template void WeightSplitting<Scalar, Dim>::start_from_duals(                           \
      const WeightMatrix&, const VectorsAt<Dim>&, const WeightMatrix&);                   \
  template void WeightSplitting<Scalar, Dim>::resume();
FLBC_INSTANTIATE(float, 2)
FLBC_INSTANTIATE(float, 3)
FLBC_INSTANTIATE(double, 2)
FLBC_INSTANTIATE(double, 3)
#undef FLBC_INSTANTIATE

}  // namespace flbc::splitting
