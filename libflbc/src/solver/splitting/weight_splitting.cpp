// SPDX-License-Identifier: BSD-3-Clause
#include "solver/splitting/weight_splitting.h"

#include <omp.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/flush_denormals.h"
#include "base/parallel.h"
#include "base/simd.h"
#include "mesh/cell_geometry.h"
#include "problem/barycentric_constraints.h"
#include "solver/state_storage.h"

namespace flbc::splitting {
namespace {

// sum m grad^T grad + k over the interior vertices, ascending.
template <int Dim>
Eigen::SparseMatrix<double> system_matrix(const LbcProblem<Dim>& problem, const Metric& metric) {
  std::vector<Index> unknown(problem.mesh.num_vertices(), -1);
  Index count = 0;
  for (Index v = 0; v < problem.mesh.num_vertices(); ++v) {
    if (problem.boundary.boundary_index[v] < 0) unknown[v] = count++;
  }
  std::vector<Eigen::Triplet<double, Index>> entries;
  entries.reserve(static_cast<std::size_t>(problem.mesh.num_cells()) * (Dim + 1) * (Dim + 2) / 2);
  for (Index s = 0; s < problem.mesh.num_cells(); ++s) {
    const auto hat = cell_geometry(problem.mesh, s).hat_gradients;
    for (int a = 0; a <= Dim; ++a) {
      for (int b = 0; b <= Dim; ++b) {
        const Index row = unknown[problem.mesh.cells(a, s)];
        const Index column = unknown[problem.mesh.cells(b, s)];
        if (column < 0 || row < column) continue;
        entries.emplace_back(row, column, metric.cell[s] * hat.col(a).dot(hat.col(b)));
      }
    }
  }
  for (Index v = 0; v < problem.mesh.num_vertices() && metric.vertex.size() > 0; ++v) {
    if (unknown[v] >= 0) entries.emplace_back(unknown[v], unknown[v], metric.vertex[v]);
  }
  Eigen::SparseMatrix<double> matrix(count, count);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

}  // namespace

template <class Scalar, int Dim>
WeightSplitting<Scalar, Dim>::WeightSplitting(const LbcProblem<Dim>& problem, Metric metric,
                                              double penalty, double relaxation,
                                              LinearSolver linear_solver, StateStorage* storage)
    : problem_(problem),
      kernel_(select_kernel<Scalar, Dim>()),
      n_(problem.num_control_points()),
      stride_(row_stride(static_cast<std::size_t>(n_))),
      metric_(std::move(metric)),
      penalty_(penalty),
      relaxation_(relaxation),
      solver_(system_matrix(problem, metric_), stride_, linear_solver) {
  const auto cells = static_cast<std::size_t>(problem.mesh.num_cells());
  const auto vertices = static_cast<std::size_t>(problem.mesh.num_vertices());
  weights_ = state_array<Scalar>(storage, StateArray::kIterate, vertices, 1, stride_);
  cell_state_ = state_array<Scalar>(storage, StateArray::kSplittingState, cells, Dim, stride_);
  violation_ = AlignedArray<double>(stride_);
  violation_sum_ = AlignedArray<Scalar>(stride_);
  set_up_rows(storage);
  set_up_cells();
  set_up_constraints();
  set_radius_scale();
}

template <class Scalar, int Dim>
void WeightSplitting<Scalar, Dim>::set_up_rows(StateStorage* storage) {
  const Index boundary_row = solver_.size();
  std::vector<Index> row_of(problem_.mesh.num_vertices(), boundary_row);
  vertices_.resize(boundary_row);
  Index unknown = 0;
  for (Index v = 0; v < problem_.mesh.num_vertices(); ++v) {
    if (problem_.boundary.boundary_index[v] >= 0) continue;
    row_of[v] = solver_.position()[unknown++];
    vertices_[row_of[v]] = v;
  }
  cell_rows_.resize(problem_.mesh.cells.size());
  for (std::size_t corner = 0; corner < cell_rows_.size(); ++corner) {
    cell_rows_[corner] = row_of[problem_.mesh.cells.data()[corner]];
  }
  residual_ = AlignedArray<Scalar>((vertices_.size() + 1) * stride_);
  if (metric_.vertex.size() == 0) return;
  vertex_state_ =
      state_array<Scalar>(storage, StateArray::kNonNegativityDual,
                          static_cast<std::size_t>(problem_.mesh.num_vertices()), 1, stride_);
  for (const Index v : vertices_) {
    vertex_metric_.push_back(static_cast<Scalar>(metric_.vertex[v]));
  }
}

template <class Scalar, int Dim>
void WeightSplitting<Scalar, Dim>::set_up_cells() {
  const auto cells = static_cast<std::size_t>(problem_.mesh.num_cells());
  // A cell's phi may be as good as zero, which must not take radii into the denormal range.
  constexpr double kSmallestPhi = 1e-10;
  phi_ = AlignedArray<Scalar>(cells * stride_);
  hat_gradients_.resize(cells * Dim * Dim);
  cell_metric_.resize(cells);
  measures_.resize(cells);
  radius_scale_.resize(cells);
#pragma omp parallel for schedule(static)
  for (std::size_t s = 0; s < cells; ++s) {
    const auto geometry = cell_geometry(problem_.mesh, static_cast<Index>(s));
    Eigen::Map<Eigen::Matrix<Scalar, Dim, Dim>>(hat_gradients_.data() + s * Dim * Dim) =
        geometry.hat_gradients.template rightCols<Dim>().template cast<Scalar>();
    measures_[s] = static_cast<Scalar>(geometry.measure);
    cell_metric_[s] = static_cast<Scalar>(metric_.cell[s]);
    for (Index i = 0; i < n_; ++i) {
      phi_[s * stride_ + i] = static_cast<Scalar>(std::max(problem_.phi(i, s), kSmallestPhi));
    }
  }
}

template <class Scalar, int Dim>
void WeightSplitting<Scalar, Dim>::set_up_constraints() {
  const BarycentricConstraints<Dim> constraints(problem_.cage.points);
  basis_ = AlignedArray<Scalar>((Dim + 1) * stride_);
  for (int k = 0; k <= Dim; ++k) {
    for (Index i = 0; i < n_; ++i) {
      basis_[k * stride_ + i] = static_cast<Scalar>(constraints.basis()(i, k));
    }
  }
  row_target_.resize(vertices_.size() * (Dim + 1));
  for (std::size_t row = 0; row < vertices_.size(); ++row) {
    Eigen::Map<Eigen::Matrix<Scalar, Dim + 1, 1>>(row_target_.data() + row * (Dim + 1)) =
        constraints.weight_target(problem_.mesh.points.col(vertices_[row])).template cast<Scalar>();
  }
}

template <class Scalar, int Dim>
void WeightSplitting<Scalar, Dim>::set_radius_scale() {
  for (std::size_t s = 0; s < radius_scale_.size(); ++s) {
    radius_scale_[s] = static_cast<Scalar>(static_cast<double>(measures_[s]) /
                                           (penalty_ * metric_.cell[static_cast<Index>(s)]));
  }
}

template <class Scalar, int Dim>
Arrays<Scalar, Dim> WeightSplitting<Scalar, Dim>::arrays() {
  return {stride_,
          static_cast<std::size_t>(problem_.mesh.num_cells()),
          vertices_.size(),
          weights_.data(),
          cell_state_.data(),
          vertex_state_.data(),
          residual_.data(),
          violation_.data(),
          violation_sum_.data(),
          problem_.mesh.cells.data(),
          cell_rows_.data(),
          vertices_.data(),
          hat_gradients_.data(),
          cell_metric_.data(),
          vertex_metric_.data(),
          phi_.data(),
          radius_scale_.data(),
          basis_.data(),
          row_target_.data(),
          static_cast<Scalar>(relaxation_)};
}

// Calls `body` for each thread's slice of control points.
template <class Scalar, int Dim>
template <class Body>
void WeightSplitting<Scalar, Dim>::for_slices(const Body& body) {
  const auto state = arrays();
#pragma omp parallel
  {
    const FlushDenormals flush;
    const Slice slice = slice_of(stride_, omp_get_thread_num(), omp_get_num_threads());
    if (slice.begin < slice.end) body(state, Columns{slice.begin, slice.end});
  }
}

// One pass: each thread takes its slice of control points through `residual` and the linear system,
// then its share of the rows.
template <class Scalar, int Dim>
template <class Body>
double WeightSplitting<Scalar, Dim>::run(const Body& residual) {
  constexpr Index kRows = 256;
  const auto state = arrays();
  const auto num_rows = static_cast<Index>(vertices_.size());
  std::vector<double> change((num_rows + kRows - 1) / kRows, 0.0);
#pragma omp parallel
  {
    const FlushDenormals flush;
    const Slice slice = slice_of(stride_, omp_get_thread_num(), omp_get_num_threads());
    if (slice.begin < slice.end) {
      residual(state, Columns{slice.begin, slice.end});
      solver_.solve_slice(residual_.data(), stride_, slice.begin, slice.end);
    }
#pragma omp barrier
#pragma omp for schedule(static)
    for (std::size_t block = 0; block < change.size(); ++block) {
      const Index begin = static_cast<Index>(block) * kRows;
      change[block] = kernel_.update_weights(state, begin, std::min(num_rows, begin + kRows));
    }
  }
  double sum = 0;
  for (const double part : change) sum += part;
  return sum;
}

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
  const double numbers = static_cast<double>(vertices_.size()) * n_;
  for (int step = 0; step < steps; ++step) {
    if (run(kernel_.harmonic_residual) <= kSmallChange * numbers) break;
  }
  start_from_weights(weights());
}

// Sets y = grad w - p and q = w + vertex_dual where `add` is zero, else adds to them.
template <class Scalar, int Dim>
template <class CellVectors>
void WeightSplitting<Scalar, Dim>::set_states(Scalar add, const WeightMatrix& weights,
                                              const CellVectors& cell_vectors) {
#pragma omp parallel for schedule(static)
  for (Index s = 0; s < problem_.mesh.num_cells(); ++s) {
    const Eigen::Matrix<double, Eigen::Dynamic, Dim> vectors = cell_vectors(s);
    for (int d = 0; d < Dim; ++d) {
      Scalar* row = cell_state_.data() + (static_cast<std::size_t>(s) * Dim + d) * stride_;
      for (Index i = 0; i < n_; ++i) row[i] = add * row[i] + static_cast<Scalar>(vectors(i, d));
    }
  }
  if (vertex_state_.size() == 0) return;
  for (const Index v : vertices_) {
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
        return (gradients(s, weights) - static_cast<double>(radius_scale_[s]) * flux_density(s))
            .eval();
      });
  run([&](Arrays<Scalar, Dim> state, Columns columns) {
    state.relaxation = 0;  // the residual alone
    kernel_.update_vertices(state, columns);
    kernel_.update_cells(state, columns);
  });
  const WeightMatrix back = weights - this->weights();
  set_states(1, back, [&](Index s) { return gradients(s, back); });
  set_weights(weights);
}

template <class Scalar, int Dim>
WeightMatrix WeightSplitting<Scalar, Dim>::vertex_dual() const {
  if (vertex_state_.size() == 0) return {};
  WeightMatrix dual = WeightMatrix::Zero(n_, problem_.mesh.num_vertices());
  for (const Index v : vertices_) {
    for (Index i = 0; i < n_; ++i) {
      const std::size_t place = v * stride_ + i;
      dual(i, v) = static_cast<double>(vertex_state_[place] - weights_[place]);
    }
  }
  return dual;
}

template <class Scalar, int Dim>
Step WeightSplitting<Scalar, Dim>::iterate() {
  return {run([&](const Arrays<Scalar, Dim>& state, Columns columns) {
    kernel_.update_vertices(state, columns);
    kernel_.update_cells(state, columns);
  })};
}

template <class Scalar, int Dim>
Step WeightSplitting<Scalar, Dim>::iterate_measured() {
  std::fill_n(violation_.data(), violation_.size(), 0.0);
  Step step{run([&](const Arrays<Scalar, Dim>& state, Columns columns) {
    kernel_.update_vertices_measured(state, columns);
    kernel_.update_cells_measured(state, columns);
  })};
  step.violation = std::accumulate(violation_.data(), violation_.data() + n_, 0.0);
  return step;
}

template <class Scalar, int Dim>
Residuals WeightSplitting<Scalar, Dim>::iterate_with_residuals() {
  AlignedArray<Scalar> before(weights_.size());
  std::copy_n(weights_.data(), weights_.size(), before.data());
  const Step step = iterate_measured();
  return {std::sqrt(step.violation), penalty_ * std::sqrt(weight_change_norm2(before))};
}

// Squared norm, in the metric, of what an iteration changed in the gradients and the weights.
template <class Scalar, int Dim>
double WeightSplitting<Scalar, Dim>::weight_change_norm2(const AlignedArray<Scalar>& before) const {
  using Row = Eigen::Map<const Eigen::Array<Scalar, Eigen::Dynamic, 1>>;
  const auto change = [&](Index v) -> Eigen::ArrayXd {
    return (Row(weights_.data() + v * stride_, n_) - Row(before.data() + v * stride_, n_))
        .template cast<double>();
  };
  double sum = parallel_sum(problem_.mesh.num_cells(), 0.0, [&](Index begin, Index end) {
    double part = 0;
    for (Index s = begin; s < end; ++s) {
      Eigen::Matrix<double, Eigen::Dynamic, Dim> gradient =
          Eigen::Matrix<double, Eigen::Dynamic, Dim>::Zero(n_, Dim);
      const Eigen::ArrayXd first = change(problem_.mesh.cells(0, s));
      for (int k = 0; k < Dim; ++k) {
        const Eigen::Map<const Eigen::Matrix<Scalar, Dim, 1>> hat(hat_gradients_.data() +
                                                                  (s * Dim + k) * Dim);
        gradient += (change(problem_.mesh.cells(k + 1, s)) - first).matrix() *
                    hat.template cast<double>().transpose();
      }
      part += metric_.cell[s] * gradient.squaredNorm();
    }
    return part;
  });
  for (const Index v : vertices_) {
    if (metric_.vertex.size() > 0) sum += metric_.vertex[v] * change(v).square().sum();
  }
  return sum;
}

template <class Scalar, int Dim>
void WeightSplitting<Scalar, Dim>::adapt_penalty(double ratio, double largest) {
  if (start_.size() == 0) return;
  AlignedArray<double> dual(stride_);
  AlignedArray<double> motion(stride_);
  for_slices([&](const Arrays<Scalar, Dim>& state, Columns columns) {
    kernel_.balance(state, columns, start_.data(), dual.data(), motion.data());
  });
  double dual2 = 0;
  double motion2 = 0;
  for (Index i = 0; i < n_; ++i) {
    dual2 += dual[i];
    motion2 += motion[i];
  }
  if (!(dual2 > 0) || !(motion2 > 0)) return;
  const double factor = std::max(1 / (ratio * std::sqrt(dual2 / motion2)), penalty_ / largest);
  for_slices([&](const Arrays<Scalar, Dim>& state, Columns columns) {
    kernel_.rescale_duals(state, columns, static_cast<Scalar>(factor));
  });
  penalty_ /= factor;
  set_radius_scale();
}

template <class Scalar, int Dim>
double WeightSplitting<Scalar, Dim>::num_residual_components() const {
  const double cells = static_cast<double>(problem_.mesh.num_cells()) * Dim;
  const double vertices = vertex_state_.size() > 0 ? static_cast<double>(vertices_.size()) : 0.0;
  return (cells + vertices) * n_;
}

template <class Scalar, int Dim>
WeightMatrix WeightSplitting<Scalar, Dim>::weights() const {
  WeightMatrix weights(n_, problem_.mesh.num_vertices());
  for (Index v = 0; v < problem_.mesh.num_vertices(); ++v) {
    for (Index i = 0; i < n_; ++i) weights(i, v) = static_cast<double>(weights_[v * stride_ + i]);
  }
  // Boundary values are known better than single precision holds them.
  for (std::size_t b = 0; b < problem_.boundary.vertices.size(); ++b) {
    auto column = weights.col(problem_.boundary.vertices[b]);
    column.setZero();
    problem_.boundary.scatter(static_cast<Index>(b), column);
  }
  return weights;
}

template <class Scalar, int Dim>
CellFieldView<Scalar, Dim> WeightSplitting<Scalar, Dim>::flux() {
  flux_ = AlignedArray<Scalar>(cell_state_.size());
  std::vector<Scalar> scale(cell_metric_.size());
  for (std::size_t s = 0; s < scale.size(); ++s) {
    scale[s] = static_cast<Scalar>(penalty_ * metric_.cell[static_cast<Index>(s)]);
  }
  for_slices([&](const Arrays<Scalar, Dim>& state, Columns columns) {
    kernel_.flux(state, columns, scale.data(), flux_.data());
  });
  return {flux_.data(), stride_, n_};
}

template <class Scalar, int Dim>
double WeightSplitting<Scalar, Dim>::state_scalars_per_cell() const {
  const std::size_t numbers =
      weights_.size() + cell_state_.size() + vertex_state_.size() + residual_.size();
  return static_cast<double>(numbers) / static_cast<double>(stride_) / problem_.mesh.num_cells();
}

template class WeightSplitting<float, 2>;
template class WeightSplitting<float, 3>;
template class WeightSplitting<double, 2>;
template class WeightSplitting<double, 3>;

}  // namespace flbc::splitting
