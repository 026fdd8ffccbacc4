// SPDX-License-Identifier: BSD-3-Clause
// Where the iteration starts from.
#include <algorithm>

#include "mesh/cell_geometry.h"
#include "solver/splitting/weight_splitting.h"

namespace flbc::splitting {

template <class Scalar, int Dim>
void WeightSplitting<Scalar, Dim>::set_weights(const WeightMatrix& weights) {
  for (Index v = 0; v < problem_.mesh.num_vertices(); ++v) {
    for (Index i = 0; i < n_; ++i) weights_[v * stride_ + i] = static_cast<Scalar>(weights(i, v));
  }
}

template <class Scalar, int Dim>
void WeightSplitting<Scalar, Dim>::start_from_weights(const WeightMatrix& weights) {
  set_weights(weights);
  std::copy_n(weights_.data(), vertex_state_.size(), vertex_state_.data());
  std::fill_n(cell_state_.data(), cell_state_.size(), Scalar(0));
  remember_start();
}

template <class Scalar, int Dim>
void WeightSplitting<Scalar, Dim>::remember_start() {
  start_ = AlignedArray<Scalar>(weights_.size());
  std::copy_n(weights_.data(), weights_.size(), start_.data());
}

template <class Scalar, int Dim>
void WeightSplitting<Scalar, Dim>::resume() {
  set_boundary_weights();
  remember_start();
}

template <class Scalar, int Dim>
void WeightSplitting<Scalar, Dim>::set_boundary_weights() {
  Eigen::VectorXd row(n_);
  for (std::size_t b = 0; b < problem_.boundary.vertices.size(); ++b) {
    row.setZero();
    problem_.boundary.scatter(static_cast<Index>(b), row);
    Scalar* weights = weights_.data() + problem_.boundary.vertices[b] * stride_;
    for (Index i = 0; i < n_; ++i) weights[i] = static_cast<Scalar>(row[i]);
  }
}

template <class Scalar, int Dim>
void WeightSplitting<Scalar, Dim>::start_from_harmonic(int steps) {
  // The first step from zero is much the longest; later ones only make up for the vertex metric.
  constexpr double kSmallChange = 1e-9;
  std::fill_n(weights_.data(), weights_.size(), Scalar(0));
  set_boundary_weights();
  const double numbers = static_cast<double>(data_.vertices.size()) * n_;
  for (int step = 0; step < steps; ++step) {
    if (run(kernel_.harmonic_residual) <= kSmallChange * numbers) break;
  }
  start_from_weights(weights());
}

// Sets y = grad w - p and q = w + vertex_dual where `add` is zero, else adds to them.
template <class Scalar, int Dim>
void WeightSplitting<Scalar, Dim>::set_states(Scalar add, const WeightMatrix& weights,
                                              const VectorsAt<Dim>& cell_vectors) {
#pragma omp parallel for schedule(static)
  for (Index s = 0; s < problem_.mesh.num_cells(); ++s) {
    const Eigen::Matrix<double, Eigen::Dynamic, Dim> vectors = cell_vectors(s);
    for (int d = 0; d < Dim; ++d) {
      Scalar* row = cell_state_.data() + (static_cast<std::size_t>(s) * Dim + d) * stride_;
      for (Index i = 0; i < n_; ++i) row[i] = add * row[i] + static_cast<Scalar>(vectors(i, d));
    }
  }
  if (vertex_state_.size() == 0) return;
  for (const Index v : data_.vertices) {
    Scalar* row = vertex_state_.data() + v * stride_;
    for (Index i = 0; i < n_; ++i) row[i] = add * row[i] + static_cast<Scalar>(weights(i, v));
  }
}

// Every iteration leaves weights whose gradients are the feasible ones nearest to the state. Duals
// from elsewhere would move the weights to get there; so what they would do is taken from the state
// instead, at the price of one solve.
template <class Scalar, int Dim>
void WeightSplitting<Scalar, Dim>::start_from_duals(const WeightMatrix& weights,
                                                    const VectorsAt<Dim>& flux_density,
                                                    const WeightMatrix& vertex_dual) {
  const auto gradients = [&](Index s, const WeightMatrix& of) {
    return weight_gradients(problem_.mesh, s, cell_geometry(problem_.mesh, s), of);
  };
  set_weights(weights);
  set_states(
      0, vertex_dual.size() > 0 ? WeightMatrix(weights + vertex_dual) : weights, [&](Index s) {
        return (gradients(s, weights) - static_cast<double>(data_.radius_scale[s]) * flux_density(s))
            .eval();
      });
  run([&](Arrays<Scalar, Dim> state, Columns columns) {
    state.relaxation = 0;  // the residual alone
    kernel_.w_step(state, columns);
    kernel_.z_step(state, columns);
  });
  const WeightMatrix back = weights - this->weights();
  set_states(1, back, [&](Index s) { return gradients(s, back); });
  set_weights(weights);
}

#define FLBC_INSTANTIATE(Scalar, Dim)                                                         \
  template void WeightSplitting<Scalar, Dim>::resume();                                       \
  template void WeightSplitting<Scalar, Dim>::start_from_weights(const WeightMatrix&);        \
  template void WeightSplitting<Scalar, Dim>::start_from_harmonic(int);                       \
  template void WeightSplitting<Scalar, Dim>::start_from_duals(                               \
      const WeightMatrix&, const VectorsAt<Dim>&, const WeightMatrix&);
FLBC_INSTANTIATE(float, 2)
FLBC_INSTANTIATE(float, 3)
FLBC_INSTANTIATE(double, 2)
FLBC_INSTANTIATE(double, 3)
#undef FLBC_INSTANTIATE

}  // namespace flbc::splitting
