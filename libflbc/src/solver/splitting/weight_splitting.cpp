// SPDX-License-Identifier: BSD-3-Clause
#include "solver/splitting/weight_splitting.h"

#include <omp.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/flush_denormals.h"
#include "base/parallel.h"
#include "solver/state_storage.h"

namespace flbc::splitting {

template <class Scalar, int Dim>
WeightSplitting<Scalar, Dim>::WeightSplitting(const LbcProblem<Dim>& problem, Metric metric,
                                              double penalty, double relaxation,
                                              LinearSolver linear_solver, StateStorage* storage)
    : problem_(problem),
      kernel_(select_kernel<Kernel<Scalar, Dim>>()),
      n_(problem.num_control_points()),
      stride_(padded(static_cast<std::size_t>(n_))),
      slices_(stride_, omp_get_max_threads(), storage != nullptr),
      metric_(std::move(metric)),
      penalty_(penalty),
      relaxation_(relaxation),
      solver_(system_matrix(problem, metric_), stride_, linear_solver),
      data_(make_splitting_data<Scalar>(problem, metric_, solver_.position(), slices_)) {
  const auto cells = static_cast<std::size_t>(problem.mesh.num_cells());
  const auto vertices = static_cast<std::size_t>(problem.mesh.num_vertices());
  weights_ = state_array<Scalar>(storage, StateArray::kIterate, vertices, 1, stride_);
  cell_state_ = state_array<Scalar>(storage, StateArray::kSplittingState, cells, Dim, stride_);
  if (metric_.vertex.size() > 0) {
    vertex_state_ =
        state_array<Scalar>(storage, StateArray::kNonNegativityDual, vertices, 1, stride_);
  }
  residual_ = AlignedArray<Scalar>((data_.vertices.size() + 1) * stride_);
  violation_ = AlignedArray<double>(stride_);
  violation_sum_ = AlignedArray<Scalar>(stride_);
  data_.set_radius_scale(metric_, penalty_);
}

template <class Scalar, int Dim>
Arrays<Scalar, Dim> WeightSplitting<Scalar, Dim>::arrays(Slice slice) {
  Arrays<Scalar, Dim> arrays;
  arrays.stride = stride_;
  arrays.cell_stride = slices_.stride_of(slice);
  arrays.num_cells = static_cast<std::size_t>(problem_.mesh.num_cells());
  arrays.num_interior = data_.vertices.size();
  arrays.weights = weights_.data();
  arrays.cell_state = cell_state_.data() + slices_.offset_of(slice, arrays.num_cells * Dim);
  arrays.vertex_state = vertex_state_.data();
  arrays.residual = residual_.data();
  arrays.violation = violation_.data();
  arrays.violation_sum = violation_sum_.data();
  arrays.cells = problem_.mesh.cells.data();
  arrays.cell_rows = data_.cell_rows.data();
  arrays.vertices = data_.vertices.data();
  arrays.hat_gradients = data_.hat_gradients.data();
  arrays.cell_metric = data_.cell_metric.data();
  arrays.vertex_metric = data_.vertex_metric.data();
  arrays.phi = data_.phi.data() + slices_.offset_of(slice, arrays.num_cells);
  arrays.radius_scale = data_.radius_scale.data();
  arrays.basis = data_.constraints.basis.data();
  arrays.row_target = data_.constraints.target.data();
  arrays.largest_weight = static_cast<Scalar>(metric_.largest_weight);
  arrays.relaxation = static_cast<Scalar>(relaxation_);
  return arrays;
}

// Calls `body` for each slice of control points; to be called by all threads of a team.
template <class Scalar, int Dim>
void WeightSplitting<Scalar, Dim>::for_slices(const SliceLoop& body) {
  const FlushDenormals flush;
#pragma omp for schedule(static, 1)
  for (std::size_t k = 0; k < slices_.size(); ++k) {
    const Slice slice = slices_[k];
    body(arrays(slice), Columns{slice.begin, slice.end});
  }
}

// One pass: each thread takes its slice of control points through `residual` and the linear system,
// then its share of the rows.
template <class Scalar, int Dim>
double WeightSplitting<Scalar, Dim>::run(const SliceLoop& residual) {
  constexpr Index kRows = 256;
  const auto state = arrays(slices_[0]);
  const auto num_rows = static_cast<Index>(data_.vertices.size());
  std::vector<double> change((num_rows + kRows - 1) / kRows, 0.0);
#pragma omp parallel
  {
    const FlushDenormals flush;
    for_slices([&](const Arrays<Scalar, Dim>& slice, Columns columns) {
      residual(slice, columns);
      solver_.solve_slice(residual_.data(), stride_, columns.begin, columns.end);
    });
#pragma omp for schedule(static)
    for (std::size_t block = 0; block < change.size(); ++block) {
      const Index begin = static_cast<Index>(block) * kRows;
      change[block] = kernel_.y_step(state, begin, std::min(num_rows, begin + kRows));
    }
  }
  double sum = 0;
  for (const double part : change) sum += part;
  return sum;
}

template <class Scalar, int Dim>
double WeightSplitting<Scalar, Dim>::iterate() {
  return run([&](const Arrays<Scalar, Dim>& state, Columns columns) {
    kernel_.w_step(state, columns);
    kernel_.z_step(state, columns);
  });
}

template <class Scalar, int Dim>
Residuals WeightSplitting<Scalar, Dim>::iterate_with_residuals() {
  if (right_side_.size() == 0) right_side_ = AlignedArray<Scalar>(residual_.size());
  std::fill_n(violation_.data(), violation_.size(), 0.0);
  run([&](const Arrays<Scalar, Dim>& state, Columns columns) {
    kernel_.w_step_measured(state, columns);
    kernel_.z_step_measured(state, columns);
    keep_right_side(columns);
  });
  const double violation = std::accumulate(violation_.data(), violation_.data() + n_, 0.0);
  return {std::sqrt(violation), penalty_ * std::sqrt(std::max(change_norm2(), 0.0))};
}

template <class Scalar, int Dim>
void WeightSplitting<Scalar, Dim>::keep_right_side(Columns columns) {
  for (std::size_t row = 0; row < data_.vertices.size(); ++row) {
    std::copy(residual_.data() + row * stride_ + columns.begin,
              residual_.data() + row * stride_ + columns.end,
              right_side_.data() + row * stride_ + columns.begin);
  }
}

// Squared norm, in the metric, of what an iteration changed in the gradients and the weights: with
// the system matrix K, <delta, K delta>. The Y-step solves K delta = P r, P the projection of rows
// on what the constraints leave free, so that this is <delta, P r>.
template <class Scalar, int Dim>
double WeightSplitting<Scalar, Dim>::change_norm2() const {
  using Row = Eigen::Map<const Eigen::Matrix<Scalar, Eigen::Dynamic, 1>>;
  Eigen::Matrix<double, Eigen::Dynamic, Dim + 1> basis(n_, Dim + 1);
  for (int k = 0; k <= Dim; ++k) {
    basis.col(k) = Row(data_.constraints.basis.data() + k * stride_, n_).template cast<double>();
  }
  const auto rows = static_cast<Index>(data_.vertices.size());
  return parallel_sum(rows, 0.0, [&](Index begin, Index end) {
    double part = 0;
    Eigen::VectorXd right(n_);
    for (Index row = begin; row < end; ++row) {
      right = Row(right_side_.data() + row * stride_, n_).template cast<double>();
      const Eigen::Matrix<double, Dim + 1, 1> fixed = basis.transpose() * right;
      right.noalias() -= basis * fixed;
      part += right.dot(Row(residual_.data() + row * stride_, n_).template cast<double>());
    }
    return part;
  });
}

template <class Scalar, int Dim>
double WeightSplitting<Scalar, Dim>::num_residual_components() const {
  const double cells = static_cast<double>(problem_.mesh.num_cells()) * Dim;
  const double vertices =
      vertex_state_.size() > 0 ? static_cast<double>(data_.vertices.size()) : 0.0;
  return (cells + vertices) * n_;
}

template <class Scalar, int Dim>
WeightMatrix WeightSplitting<Scalar, Dim>::weights() const {
  WeightMatrix weights(n_, problem_.mesh.num_vertices());
  for (Index v = 0; v < problem_.mesh.num_vertices(); ++v) {
    for (Index i = 0; i < n_; ++i) weights(i, v) = static_cast<double>(weights_[v * stride_ + i]);
  }
  // Boundary values are known better than single precision holds them.
  problem_.boundary.impose_on(weights);
  return weights;
}

template <class Scalar, int Dim>
WeightMatrix WeightSplitting<Scalar, Dim>::vertex_dual() const {
  if (vertex_state_.size() == 0) return {};
  WeightMatrix dual = WeightMatrix::Zero(n_, problem_.mesh.num_vertices());
  for (const Index v : data_.vertices) {
    for (Index i = 0; i < n_; ++i) {
      dual(i, v) = static_cast<double>(vertex_state_[v * stride_ + i] - weights_[v * stride_ + i]);
    }
  }
  return dual;
}

template <class Scalar, int Dim>
CellFieldView<Scalar, Dim> WeightSplitting<Scalar, Dim>::flux() {
  flux_ = AlignedArray<Scalar>(cell_state_.size());
  std::vector<Scalar> scale(data_.cell_metric.size());
  for (std::size_t s = 0; s < scale.size(); ++s) {
    scale[s] = static_cast<Scalar>(penalty_ * metric_.cell[static_cast<Index>(s)]);
  }
#pragma omp parallel
  for_slices([&](const Arrays<Scalar, Dim>& slice, Columns columns) {
    kernel_.flux(slice, columns, scale.data(), flux_.data());
  });
  return {flux_.data(), stride_, n_};
}

template <class Scalar, int Dim>
double WeightSplitting<Scalar, Dim>::state_scalars_per_cell() const {
  const std::size_t numbers =
      weights_.size() + cell_state_.size() + vertex_state_.size() + residual_.size();
  return static_cast<double>(numbers) / static_cast<double>(stride_) / problem_.mesh.num_cells();
}

#define FLBC_INSTANTIATE(Scalar, Dim)                                                            \
  template WeightSplitting<Scalar, Dim>::WeightSplitting(const LbcProblem<Dim>&, Metric, double, \
                                                         double, LinearSolver, StateStorage*);   \
  template double WeightSplitting<Scalar, Dim>::run(const SliceLoop&);                           \
  template double WeightSplitting<Scalar, Dim>::iterate();                                       \
  template Residuals WeightSplitting<Scalar, Dim>::iterate_with_residuals();                     \
  template double WeightSplitting<Scalar, Dim>::num_residual_components() const;                 \
  template WeightMatrix WeightSplitting<Scalar, Dim>::weights() const;                           \
  template WeightMatrix WeightSplitting<Scalar, Dim>::vertex_dual() const;                       \
  template CellFieldView<Scalar, Dim> WeightSplitting<Scalar, Dim>::flux();                      \
  template double WeightSplitting<Scalar, Dim>::state_scalars_per_cell() const;
FLBC_INSTANTIATE(float, 2)
FLBC_INSTANTIATE(float, 3)
FLBC_INSTANTIATE(double, 2)
FLBC_INSTANTIATE(double, 3)
#undef FLBC_INSTANTIATE

}  // namespace flbc::splitting
