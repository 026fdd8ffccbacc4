// SPDX-License-Identifier: BSD-3-Clause
// Where the compact splitting starts from, and how it leaves its state behind.
#include <algorithm>
#include <cmath>
#include <utility>

#include "mesh/cell_geometry.h"
#include "solver/splitting/compact_splitting.h"
#include "solver/state_storage.h"

namespace flbc::compact {

template <class Scalar, class Stored, int Dim>
template <class Other>
CompactSplitting<Scalar, Stored, Dim>::CompactSplitting(
    CompactSplitting<Scalar, Other, Dim>&& other, StateStorage* storage)
    : problem_(other.problem_),
      kernel_(select_kernel<Kernel<Scalar, Stored, Dim>>()),
      n_(other.n_),
      stride_(other.stride_),
      slices_(other.slices_),
      metric_(other.metric_),
      unit_(other.unit_),
      penalty_(other.penalty_),
      relaxation_(other.relaxation_),
      solver_(std::move(other.solver_)),
      data_(make_compact_data(problem_, metric_, solver_.position(), unit_, slices_, kernel_)),
      extrapolated_(std::move(other.extrapolated_)),
      relaxed_(std::move(other.relaxed_)),
      vertex_dual_(std::move(other.vertex_dual_)),
      residual_(std::move(other.residual_)),
      stored_extrapolated_(std::move(other.stored_extrapolated_)),
      start_(std::move(other.start_)),
      difference_(std::move(other.difference_)) {
  const std::size_t size = other.cell_dual_.size();
  AlignedArray<Scalar> dual(size);
  other.kernel_.decode(other.cell_dual_.data(), dual.data(), size);
  if (storage == nullptr) {
    cell_dual_ = std::move(dual);
    return;
  }
  const auto cells = static_cast<std::size_t>(problem_.mesh.num_cells());
  cell_dual_ = state_array<Stored>(storage, StateArray::kSplittingState, cells, Dim, stride_);
  kernel_.encode(dual.data(), cell_dual_.data(), size);
}

// a and W, both sigma w.
template <class Scalar, class Stored, int Dim>
void CompactSplitting<Scalar, Stored, Dim>::set_weights(const VectorsAt<1>& weights) {
#pragma omp parallel for schedule(static)
  for (std::size_t row = 0; row < data_.vertices.size(); ++row) {
    const Index v = data_.vertices[row];
    const Eigen::VectorXd at_vertex = weights(v);
    for (Index i = 0; i < n_; ++i) {
      extrapolated_[row * stride_ + i] = relaxed_[v * stride_ + i] =
          static_cast<Scalar>(sigma() * at_vertex[i]);
    }
  }
  set_boundary_rows();
}

template <class Scalar, class Stored, int Dim>
void CompactSplitting<Scalar, Stored, Dim>::set_boundary_rows() {
  Eigen::VectorXd row(n_);
  for (std::size_t b = 0; b < problem_.boundary.vertices.size(); ++b) {
    row.setZero();
    problem_.boundary.scatter(static_cast<Index>(b), row);
    Scalar* weights = extrapolated_.data() + (data_.vertices.size() + b) * stride_;
    for (Index i = 0; i < n_; ++i) weights[i] = static_cast<Scalar>(sigma() * row[i]);
  }
}

template <class Scalar, class Stored, int Dim>
void CompactSplitting<Scalar, Stored, Dim>::start_from_weights(const WeightMatrix& weights) {
  set_weights([&](Index v) -> Eigen::VectorXd { return weights.col(v); });
  begin_from_weights();
}

template <class Scalar, class Stored, int Dim>
void CompactSplitting<Scalar, Stored, Dim>::start_from_harmonic(int steps) {
  // The first step from zero is much the longest; later ones only make up for the vertex metric.
  constexpr double kSmallChange = 1e-9;
  std::fill_n(extrapolated_.data(), extrapolated_.size(), Scalar(0));
  std::fill_n(residual_.data(), residual_.size(), Scalar(0));
  set_boundary_rows();
  const double numbers = static_cast<double>(data_.vertices.size()) * n_ * sigma() * sigma();
  for (int step = 0; step < steps; ++step) {
    if (run(arrays(), kernel_.harmonic_residual, kernel_.correct).change <= kSmallChange * numbers)
      break;
  }
  begin_from_weights();
}

// From w in the rows of a: W = w, S = 0, P = grad w.
template <class Scalar, class Stored, int Dim>
void CompactSplitting<Scalar, Stored, Dim>::begin_from_weights() {
#pragma omp parallel for schedule(static)
  for (std::size_t row = 0; row < data_.vertices.size(); ++row) {
    std::copy_n(extrapolated_.data() + row * stride_, stride_,
                relaxed_.data() + data_.vertices[row] * stride_);
  }
  std::fill_n(vertex_dual_.data(), vertex_dual_.size(), Scalar(0));
#pragma omp parallel
  for_slices(arrays(), kernel_.start_cell_dual);
  run(arrays(), nullptr, kernel_.w_step);
  start_ = AlignedArray<Scalar>(data_.vertices.size() * stride_);
  std::copy_n(extrapolated_.data(), start_.size(), start_.data());
}

// Every iteration leaves w and W such that w = W + the solution, projected. Duals from elsewhere
// would move the weights; so what they would do is taken from W instead, at the price of one solve.
template <class Scalar, class Stored, int Dim>
void CompactSplitting<Scalar, Stored, Dim>::start_from_duals(const VectorsAt<1>& weights,
                                                             const VectorsAt<Dim>& flux_density,
                                                             const VectorsAt<1>& vertex_dual) {
  set_weights(weights);
#pragma omp parallel
  {
    AlignedArray<Scalar> rows(Dim * stride_);
#pragma omp for schedule(static)
    for (std::size_t k = 0; k < data_.cells.size(); ++k) {
      const Index s = data_.cell_index[k];
      const double scale = dual_scale(problem_, metric_, unit_, s);
      const Eigen::Matrix<double, Eigen::Dynamic, Dim> density = flux_density(s);
      for (int d = 0; d < Dim; ++d) {
        for (Index i = 0; i < n_; ++i) {
          rows[d * stride_ + i] = static_cast<Scalar>(scale * density(i, d));
        }
      }
      for (int d = 0; d < Dim; ++d) {
        slices_.for_each(static_cast<std::size_t>(s) * Dim + d,
                         static_cast<std::size_t>(problem_.mesh.num_cells()) * Dim,
                         [&](std::size_t begin, std::size_t width, std::size_t place) {
                           kernel_.encode(rows.data() + d * stride_ + begin,
                                          cell_dual_.data() + place, width);
                         });
      }
    }
  }
  std::fill_n(vertex_dual_.data(), vertex_dual_.size(), Scalar(0));
  const std::size_t rows_with_dual =
      vertex_dual_.size() > 0 && vertex_dual ? data_.vertices.size() : 0;
#pragma omp parallel for schedule(static)
  for (std::size_t row = 0; row < rows_with_dual; ++row) {
    const Index v = data_.vertices[row];
    const Eigen::VectorXd at_vertex = vertex_dual(v);
    for (Index i = 0; i < n_; ++i) {
      vertex_dual_[v * stride_ + i] = static_cast<Scalar>(sigma() * at_vertex[i]);
    }
  }
  set_residual();
  auto state = arrays();
  state.relaxation = 0;  // the residual alone
  run(state, kernel_.z_step, kernel_.correct);
#pragma omp parallel for schedule(static)
  for (std::size_t row = 0; row < data_.vertices.size(); ++row) {
    Scalar* relaxed = relaxed_.data() + data_.vertices[row] * stride_;
    for (std::size_t i = 0; i < stride_; ++i) {
      relaxed[i] = 2 * relaxed[i] - extrapolated_[row * stride_ + i];
    }
  }
  run(arrays(), nullptr, kernel_.w_step);
}

// The vertices' part of the right-hand side, which an iteration leaves for the next one.
template <class Scalar, class Stored, int Dim>
void CompactSplitting<Scalar, Stored, Dim>::set_residual() {
  std::fill_n(residual_.data(), residual_.size(), Scalar(0));
#pragma omp parallel for schedule(static)
  for (std::size_t row = 0; row < data_.vertex_metric.size(); ++row) {
    const Scalar* dual = vertex_dual_.data() + data_.vertices[row] * stride_;
    for (std::size_t i = 0; i < stride_; ++i) {
      residual_[row * stride_ + i] = data_.vertex_metric[row] * dual[i];
    }
  }
}

template <class Scalar, class Stored, int Dim>
void CompactSplitting<Scalar, Stored, Dim>::resume() {
  for (std::size_t v = 0; v < data_.row_of.size(); ++v) {
    std::copy_n(stored_extrapolated_.data() + v * stride_, stride_,
                extrapolated_.data() + data_.row_of[v] * stride_);
  }
  set_boundary_rows();
  set_residual();
}

template <class Scalar, class Stored, int Dim>
void CompactSplitting<Scalar, Stored, Dim>::finish() {
  if (stored_extrapolated_.size() == 0) return;
  for (std::size_t v = 0; v < data_.row_of.size(); ++v) {
    std::copy_n(extrapolated_.data() + data_.row_of[v] * stride_, stride_,
                stored_extrapolated_.data() + v * stride_);
  }
}

#define FLBC_INSTANTIATE(Scalar, Stored, Dim)                                                   \
  template void CompactSplitting<Scalar, Stored, Dim>::set_boundary_rows();                     \
  template void CompactSplitting<Scalar, Stored, Dim>::start_from_weights(const WeightMatrix&); \
  template void CompactSplitting<Scalar, Stored, Dim>::start_from_harmonic(int);                \
  template void CompactSplitting<Scalar, Stored, Dim>::start_from_duals(                        \
      const VectorsAt<1>&, const VectorsAt<Dim>&, const VectorsAt<1>&);                         \
  template void CompactSplitting<Scalar, Stored, Dim>::resume();                                \
  template void CompactSplitting<Scalar, Stored, Dim>::finish();
FLBC_INSTANTIATE(float, Half, 2)
FLBC_INSTANTIATE(float, Half, 3)
FLBC_INSTANTIATE(float, float, 2)
FLBC_INSTANTIATE(float, float, 3)
FLBC_INSTANTIATE(double, double, 2)
FLBC_INSTANTIATE(double, double, 3)
#undef FLBC_INSTANTIATE
template CompactSplitting<float, float, 2>::CompactSplitting(CompactSplitting<float, Half, 2>&&,
                                                             StateStorage*);
template CompactSplitting<float, float, 3>::CompactSplitting(CompactSplitting<float, Half, 3>&&,
                                                             StateStorage*);

}  // namespace flbc::compact
