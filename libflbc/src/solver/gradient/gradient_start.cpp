// SPDX-License-Identifier: BSD-3-Clause
// Where the iteration starts from.
#include "mesh/cell_geometry.h"
#include "solver/gradient/gradient_admm.h"

namespace flbc::gradient {

template <class Scalar, int Dim>
void GradientAdmm<Scalar, Dim>::start_from_least_norm() {
#pragma omp parallel for schedule(static)
  for (Index s = 0; s < problem_.mesh.num_cells(); ++s) {
    for (int d = 0; d < Dim; ++d) {
      const std::size_t row = (static_cast<std::size_t>(s) * Dim + d) * stride_;
      for (std::size_t i = 0; i < stride_; ++i) {
        Scalar value = 0;
        for (int k = 0; k <= Dim; ++k)
          value += data_.target[d * (Dim + 1) + k] * data_.basis[k * stride_ + i];
        gradient_[row + i] = extrapolated_[row + i] = value;
      }
    }
  }
}

template <class Scalar, int Dim>
void GradientAdmm<Scalar, Dim>::start_from_weights(const WeightMatrix& weights) {
#pragma omp parallel for schedule(static)
  for (Index s = 0; s < problem_.mesh.num_cells(); ++s) {
    const auto gradient =
        weight_gradients(problem_.mesh, s, cell_geometry(problem_.mesh, s), weights);
    for (int d = 0; d < Dim; ++d) {
      const std::size_t row = (static_cast<std::size_t>(s) * Dim + d) * stride_;
      for (Index i = 0; i < n_; ++i) {
        gradient_[row + i] = extrapolated_[row + i] = static_cast<Scalar>(gradient(i, d));
      }
    }
  }
}

template <class Scalar, int Dim>
void GradientAdmm<Scalar, Dim>::start_from_duals(const WeightMatrix& weights,
                                                 const VectorsAt<Dim>& flux_density,
                                                 const VectorsAt<Dim>& facet_multiplier,
                                                 const Eigen::MatrixXd& period_factors) {
  start_from_weights(weights);
  // Rows of an array from those of a matrix, a column each.
  const auto store = [&](AlignedArray<Scalar>& array, Index element, const auto& columns) {
    for (Eigen::Index k = 0; k < columns.cols(); ++k) {
      const std::size_t row = static_cast<std::size_t>(element * columns.cols() + k) * stride_;
      for (Index i = 0; i < n_; ++i) array[row + i] = static_cast<Scalar>(columns(i, k) / penalty_);
    }
  };
#pragma omp parallel for schedule(static)
  for (Index s = 0; s < problem_.mesh.num_cells(); ++s) {
    store(tv_dual_, s, (-cell_geometry(problem_.mesh, s).measure * flux_density(s)).eval());
  }
#pragma omp parallel for schedule(static)
  for (Index f = 0; f < problem_.topology.num_facets(); ++f) {
    store(facet_dual_, f, (facet_multiplier(f) * tangent_basis(problem_, f)).eval());
  }
  for (std::size_t p = 0; p < num_periods_; ++p) {
    const auto column = static_cast<Eigen::Index>(p);
    store(period_dual_, static_cast<Index>(p),
          (period_norms_[p] * period_factors.col(column)).eval());
  }
}

#define FLBC_INSTANTIATE(Scalar, Dim)                                               \
  template void GradientAdmm<Scalar, Dim>::start_from_least_norm();                 \
  template void GradientAdmm<Scalar, Dim>::start_from_weights(const WeightMatrix&); \
  template void GradientAdmm<Scalar, Dim>::start_from_duals(                        \
      const WeightMatrix&, const VectorsAt<Dim>&, const VectorsAt<Dim>&, const Eigen::MatrixXd&);
FLBC_INSTANTIATE(float, 2)
FLBC_INSTANTIATE(float, 3)
FLBC_INSTANTIATE(double, 2)
FLBC_INSTANTIATE(double, 3)
#undef FLBC_INSTANTIATE

}  // namespace flbc::gradient
