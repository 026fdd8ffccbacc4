// SPDX-License-Identifier: BSD-3-Clause
#include "solver/methods/splitting/compact_splitting.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>
#include <vector>

#include "base/flush_denormals.h"
#include "base/instantiate.h"
#include "base/padded_rows.h"
#include "base/parallel.h"
#include "flbc/harmonic.h"
#include "mesh/cell_geometry.h"
#include "problem/boundary_flux.h"
#include "solver/plan/constants.h"
#include "solver/start/start.h"

namespace flbc::compact {

template <class Scalar, int Dim>
CompactSplitting<Scalar, Dim>::CompactSplitting(const LbcProblem<Dim>& problem,
                                                splitting::Metric metric,
                                                const Parameters& parameters,
                                                const Kernel<Scalar, Dim>& kernel)
    : problem_(problem),
      kernel_(kernel),
      loops_(parameters.half ? &kernel.half : &kernel.exact),
      parameters_(parameters),
      n_(problem.num_control_points()),
      stride_(padded(static_cast<std::size_t>(n_))),
      slices_(stride_, omp_get_max_threads()),
      metric_(std::move(metric)),
      unit_(radius_unit(problem, metric_)),
      penalty_(parameters.penalty),
      solver_(splitting::system_matrix(problem, metric_), stride_, parameters.linear_solver),
      data_(make_rows_and_cells<Scalar>(problem, metric_, solver_.position(), unit_)),
      rule_(false, false, problem.smoothness),
      rows_(static_cast<std::size_t>(problem.mesh.num_vertices()) * stride_,
            data_.vertices.size() * stride_, metric_.vertex.size() > 0),
      P_(data_.cells.size() * Dim * stride_ * loops_->bytes) {
  set_constraints(problem, stride_, data_);
  set_radii(problem, metric_, unit_, slices_, *loops_, data_);
}

template <class Scalar, int Dim>
Arrays<Scalar, Dim> CompactSplitting<Scalar, Dim>::arrays() {
  State arrays;
  arrays.stride = stride_;
  arrays.cell_stride = stride_;
  arrays.num_cells = data_.cells.size();
  arrays.num_interior = data_.vertices.size();
  rows_.set(arrays);
  arrays.cell_dual = P_.data();
  arrays.violation = violation_.data();
  arrays.violation_sum = violation_sum_.data();
  arrays.cells = data_.cells.data();
  arrays.cell_index = data_.cell_index.data();
  arrays.radius = data_.radius.data();
  arrays.vertex_metric = data_.vertex_metric.data();
  arrays.basis = data_.basis.data();
  arrays.row_target = data_.row_target.data();
  arrays.difference = rows_.difference.data();
  arrays.sigma = static_cast<Scalar>(sigma());
  arrays.relaxation = static_cast<Scalar>(parameters_.relaxation);
  arrays.smoothing = static_cast<Scalar>(smoothing(problem_, penalty_));
  return arrays;
}

// Calls `body` for each slice of control points, in parallel.
template <class Scalar, int Dim>
void CompactSplitting<Scalar, Dim>::for_slices(
    const State& state, const std::function<void(const State&, Columns)>& body) const {
  const auto of_slice = [&](std::size_t k) {
    const FlushDenormals flush;
    const Slice slice = slices_[k];
    const auto start_of = [&](std::size_t rows) {
      return loops_->bytes * slices_.offset_of(slice, rows);
    };
    State part = state;
    part.cell_stride = slices_.stride_of(slice);
    part.cell_dual = static_cast<unsigned char*>(state.cell_dual) + start_of(state.num_cells * Dim);
    part.radius = data_.radius.data() + start_of(state.num_cells);
    body(part, Columns{slice.begin, slice.end});
  };
  parallel_for(slices_.size(), of_slice, 2);
}

// One pass: each thread takes its slice of control points through the cells and the linear system,
// then its share of the rows. Without a loop over cells, no solve is performed.
template <class Scalar, int Dim>
RowSums CompactSplitting<Scalar, Dim>::pass(const State& state, SliceLoop cells, RowLoop rows) {
  constexpr Index kRowBlock = 256;
  const auto num_rows = static_cast<Index>(data_.vertices.size());
  std::vector<RowSums> parts((num_rows + kRowBlock - 1) / kRowBlock);
  if (cells != nullptr) {
    for_slices(state, [&](const State& slice, Columns columns) {
      cells(slice, columns);
      solver_.solve_slice(rows_.residual.data(), stride_, columns.begin, columns.end);
    });
  }
  const auto of_block = [&](std::size_t block) {
    const FlushDenormals flush;
    const Index begin = static_cast<Index>(block) * kRowBlock;
    parts[block] = rows(state, begin, std::min(num_rows, begin + kRowBlock));
  };
  parallel_for(parts.size(), of_block, 2);
  RowSums sums;
  for (const RowSums& part : parts) sums += part;
  return sums;
}

// z_step and solve for all cells, then y_step for all rows, with the next iteration's w_step.
template <class Scalar, int Dim>
Step CompactSplitting<Scalar, Dim>::iterate(int made, int count, bool measure) {
  for (int k = 1; k < count; ++k) pass(arrays(), loops_->z_step, loops_->y_step);
  const auto due = rule_.due(made + count);
  const bool looks = due == splitting::Due::kLook;
  const bool paper = looks || (measure && parameters_.paper_residuals);
  const bool measured = measure || looks;
  AlignedArray<Scalar> w;
  if (paper) w = all_rows_of_w();
  if (measured) {
    rows_.set_difference();
    violation_ = AlignedArray<double>(stride_);
    violation_sum_ = AlignedArray<Scalar>(stride_);
  }
  const RowSums sums = rows_.with_dual(due != splitting::Due::kNothing, measured, [&] {
    return measured ? pass(arrays(), loops_->z_step_measured, loops_->y_step_measured)
                    : pass(arrays(), loops_->z_step, loops_->y_step);
  });
  const double scale = 1 / (sigma() * sigma());
  if (!measured) return {scale * sums.change};
  const double of_cells = std::accumulate(violation_.data(), violation_.data() + n_, 0.0);
  Step step{scale * sums.change, scale * (of_cells + sums.violation)};
  if (paper) {
    measure_paper_residuals(std::move(w), looks ? scale * of_cells : step.violation, step);
  }
  return step;
}

// w of the interior rows; zero on the boundary, where it does not change.
template <class Scalar, int Dim>
AlignedArray<Scalar> CompactSplitting<Scalar, Dim>::all_rows_of_w() const {
  AlignedArray<Scalar> w(rows_.a.size());
  parallel_for(rows_.W.size(),
               [&](std::size_t k) { w[k] = Scalar(0.5) * (rows_.a[k] + rows_.W[k]); });
  return w;
}

// r_p is the violation of the constraints, r_d = rho times the change of the gradients and the
// weights in an iteration, both in the metric. \param moved  w before the iteration
// \param violation  squared; a look takes that of the gradients
template <class Scalar, int Dim>
void CompactSplitting<Scalar, Dim>::measure_paper_residuals(AlignedArray<Scalar> moved,
                                                            double violation, Step& step) {
  parallel_for(rows_.W.size(), [&](std::size_t k) {
    moved[k] = Scalar(0.5) * (rows_.a[k] + rows_.W[k]) - moved[k];
  });
  const std::size_t rows = rows_.S.size() > 0 ? data_.vertices.size() : 0;
  double of_rows = 0;
  for (std::size_t row = 0; row < rows; ++row) {
    const auto metric = static_cast<double>(data_.vertex_metric[row]);
    for (std::size_t i = 0; i < stride_; ++i) {
      const auto delta = static_cast<double>(moved[row * stride_ + i]);
      of_rows += metric * delta * delta;
    }
  }
  const double of_cells = squared_lengths(moved).motion2;
  const double cells = static_cast<double>(problem_.mesh.num_cells()) * Dim;
  const double components = (cells + static_cast<double>(rows)) * n_;
  step.primal = std::sqrt(violation) / components;
  step.dual = penalty_ * std::sqrt(of_cells + of_rows) / sigma() / components;
}

// |P + G (w - W)|^2 and |G moved|^2; needs w - W.
template <class Scalar, int Dim>
splitting::BalanceLengths CompactSplitting<Scalar, Dim>::squared_lengths(
    const AlignedArray<Scalar>& moved) {
  AlignedArray<double> dual(stride_);
  AlignedArray<double> motion(stride_);
  for_slices(arrays(), [&](const State& slice, Columns columns) {
    loops_->balance(slice, columns, moved.data(), dual.data(), motion.data());
  });
  return {std::accumulate(dual.data(), dual.data() + n_, 0.0),
          std::accumulate(motion.data(), motion.data() + n_, 0.0)};
}

template <class Scalar, int Dim>
splitting::BalanceLengths CompactSplitting<Scalar, Dim>::lengths_since_start() {
  auto lengths = squared_lengths(rows_.moved());
  lengths.dual2 += data_.boundary_dual2;
  return lengths;
}

template <class Scalar, int Dim>
void CompactSplitting<Scalar, Dim>::set_penalty(double penalty) {
  if (penalty == penalty_) return;
  rows_.scale_interior(static_cast<Scalar>(penalty / penalty_));
  penalty_ = penalty;
  set_boundary_rows();
}

// ---- starts -------------------------------------------------------------------------------------

template <class Scalar, int Dim>
void CompactSplitting<Scalar, Dim>::start(const Start<Dim>& start) {
  rule_ = {parameters_.balances && start.is_cold(), parameters_.looks, problem_.smoothness};
  if (!start.is_cold()) {
    start_from_duals(start);
  } else if (parameters_.harmonic_cold) {
    start_from_weights(harmonic_coordinates(problem_));
  } else {
    start_from_harmonic(plan::kHarmonicSteps);
  }
}

// a and W, both sigma w.
template <class Scalar, int Dim>
void CompactSplitting<Scalar, Dim>::set_weights(const VectorsAt<1>& weights) {
  parallel_for(data_.vertices.size(), [&](std::size_t row) {
    const Eigen::VectorXd at_vertex = weights(data_.vertices[row]);
    for (Index i = 0; i < n_; ++i) {
      rows_.a[row * stride_ + i] = rows_.W[row * stride_ + i] =
          static_cast<Scalar>(sigma() * at_vertex[i]);
    }
  });
  set_boundary_rows();
}

template <class Scalar, int Dim>
void CompactSplitting<Scalar, Dim>::set_boundary_rows() {
  Eigen::VectorXd row(n_);
  for (std::size_t b = 0; b < problem_.boundary.vertices.size(); ++b) {
    row.setZero();
    problem_.boundary.scatter(static_cast<Index>(b), row);
    Scalar* weights = rows_.a.data() + (data_.vertices.size() + b) * stride_;
    for (Index i = 0; i < n_; ++i) weights[i] = static_cast<Scalar>(sigma() * row[i]);
  }
}

template <class Scalar, int Dim>
void CompactSplitting<Scalar, Dim>::start_from_weights(const WeightMatrix& weights) {
  set_weights([&](Index v) -> Eigen::VectorXd { return weights.col(v); });
  begin_from_weights();
}

template <class Scalar, int Dim>
void CompactSplitting<Scalar, Dim>::start_from_harmonic(int steps) {
  std::fill_n(rows_.a.data(), rows_.a.size(), Scalar(0));
  std::fill_n(rows_.residual.data(), rows_.residual.size(), Scalar(0));
  set_boundary_rows();
  const double numbers = static_cast<double>(data_.vertices.size()) * n_ * sigma() * sigma();
  for (int step = 0; step < steps; ++step) {
    const auto sums = pass(arrays(), loops_->harmonic_residual, loops_->correct);
    if (sums.change <= plan::kHarmonicChange * numbers) break;
  }
  begin_from_weights();
}

// From w in the rows of a: W = w, S = 0, P = grad w.
template <class Scalar, int Dim>
void CompactSplitting<Scalar, Dim>::begin_from_weights() {
  std::copy_n(rows_.a.data(), rows_.W.size(), rows_.W.data());
  std::fill_n(rows_.S.data(), rows_.S.size(), Scalar(0));
  for_slices(arrays(), loops_->start_cell_dual);
  pass(arrays(), nullptr, loops_->w_step);
  rows_.keep_start();
}

// After every iteration, w = W + the projected solution. Given duals would move the weights, so
// their effect is subtracted from W, at the cost of one solve.
template <class Scalar, int Dim>
void CompactSplitting<Scalar, Dim>::start_from_duals(const Start<Dim>& start) {
  set_weights(start.weights);
  set_cell_dual(start.flux_density);
  set_vertex_dual(start.vertex_dual_at(penalty_));
  auto state = arrays();
  state.relaxation = 0;  // only computes the residual
  pass(state, loops_->z_step, loops_->correct);
  parallel_for(rows_.W.size(), [&](std::size_t k) { rows_.W[k] = 2 * rows_.W[k] - rows_.a[k]; });
  pass(arrays(), nullptr, loops_->w_step);
}

template <class Scalar, int Dim>
void CompactSplitting<Scalar, Dim>::set_cell_dual(const VectorsAt<Dim>& flux_density) {
  const auto set_cells = [&](std::size_t begin, std::size_t end) {
    AlignedArray<Scalar> row(stride_);
    for (std::size_t k = begin; k < end; ++k) {
      const Index s = data_.cell_index[k];
      const double scale = dual_scale(problem_, metric_, unit_, s);
      const Eigen::Matrix<double, Eigen::Dynamic, Dim> density = flux_density(s);
      for (int d = 0; d < Dim; ++d) {
        for (Index i = 0; i < n_; ++i) row[i] = static_cast<Scalar>(scale * density(i, d));
        slices_.for_each(k * Dim + d, data_.cells.size() * Dim,
                         [&](std::size_t first, std::size_t width, std::size_t place) {
                           loops_->encode(row.data() + first, P_.data(), place, width);
                         });
      }
    }
  };
  parallel_for(data_.cells.size(), set_cells);
}

// S, and the vertex part of the right-hand side, which an iteration prepares for the next one.
template <class Scalar, int Dim>
void CompactSplitting<Scalar, Dim>::set_vertex_dual(const VectorsAt<1>& vertex_dual) {
  std::fill_n(rows_.S.data(), rows_.S.size(), Scalar(0));
  std::fill_n(rows_.residual.data(), rows_.residual.size(), Scalar(0));
  if (rows_.S.size() == 0 || !vertex_dual) return;
  parallel_for(data_.vertices.size(), [&](std::size_t row) {
    const Eigen::VectorXd at_vertex = vertex_dual(data_.vertices[row]);
    for (Index i = 0; i < n_; ++i) {
      const std::size_t place = row * stride_ + i;
      rows_.S[place] = static_cast<Scalar>(sigma() * at_vertex[i]);
      rows_.residual[place] = data_.vertex_metric[row] * rows_.S[place];
    }
  });
}

// ---- adaptation ---------------------------------------------------------------------------------

template <class Scalar, int Dim>
int CompactSplitting<Scalar, Dim>::adapt(const Milestone& at) {
  if (const auto due = rule_.due(at.made); due != splitting::Due::kNothing) {
    set_penalty(due == splitting::Due::kBalance
                    ? rule_.balanced(penalty_, lengths_since_start())
                    : rule_.after_look(at.made, penalty_, at.step.primal / at.step.dual));
    pass(arrays(), nullptr, loops_->w_step);
  }
  if (stores_half() && plan::ends_half_precision(at.made, at.error)) store_in_single();
  return rule_.to_make(at.made);
}

template <class Scalar, int Dim>
void CompactSplitting<Scalar, Dim>::store_in_single() {
  const std::size_t size = data_.cells.size() * Dim * stride_;
  AlignedArray<unsigned char> exact(size * sizeof(Scalar));
  loops_->decode(P_.data(), 0, reinterpret_cast<Scalar*>(exact.data()), size);
  P_ = std::move(exact);
  loops_ = &kernel_.exact;
  set_radii(problem_, metric_, unit_, slices_, *loops_, data_);
}

// ---- results ------------------------------------------------------------------------------------

template <class Scalar, int Dim>
void CompactSplitting<Scalar, Dim>::read_weights(Index vertex, double* weights) const {
  const auto half = static_cast<Scalar>(0.5 / sigma());
  const auto row = static_cast<std::size_t>(data_.row_of[vertex]) * stride_;
  for (Index i = 0; i < n_; ++i) weights[i] = half * (rows_.a[row + i] + rows_.W[row + i]);
}

template <class Scalar, int Dim>
WeightMatrix CompactSplitting<Scalar, Dim>::all_weights() const {
  WeightMatrix weights(n_, problem_.mesh.num_vertices());
  parallel_for(data_.vertices.size(), [&](std::size_t row) {
    read_weights(data_.vertices[row], weights.col(data_.vertices[row]).data());
  });
  // Boundary values are known to higher than single precision.
  problem_.boundary.impose_on(weights);
  return weights;
}

template <class Scalar, int Dim>
Start<Dim> CompactSplitting<Scalar, Dim>::state() const {
  return splitting::start_of<Dim>(*this, n_);
}

template <class Scalar, int Dim>
Eigen::VectorXd CompactSplitting<Scalar, Dim>::vertex_dual_at(Index vertex) const {
  Eigen::VectorXd dual(n_);
  const auto row = static_cast<std::size_t>(data_.row_of[vertex]) * stride_;
  for (Index i = 0; i < n_; ++i) dual[i] = rows_.vertex_dual(row + i) / sigma();
  return dual;
}

template <class Scalar, int Dim>
Eigen::Matrix<double, Eigen::Dynamic, Dim> CompactSplitting<Scalar, Dim>::flux_density(
    Index cell) const {
  if (is_boundary_cell(problem_, cell)) return boundary_flux_density(problem_, cell);
  const auto& cells = data_.cell_index;
  const auto k =
      static_cast<std::size_t>(std::lower_bound(cells.begin(), cells.end(), cell) - cells.begin());
  const double scale = 1 / dual_scale(problem_, metric_, unit_, cell);
  AlignedArray<Scalar> row(stride_);
  Eigen::Matrix<double, Eigen::Dynamic, Dim> density(n_, Dim);
  for (int d = 0; d < Dim; ++d) {
    slices_.for_each(k * Dim + d, cells.size() * Dim,
                     [&](std::size_t begin, std::size_t width, std::size_t place) {
                       loops_->decode(P_.data(), place, row.data() + begin, width);
                     });
    for (Index i = 0; i < n_; ++i) density(i, d) = scale * row[i];
  }
  make_admissible(problem_, cell, density);
  return density;
}

template <class Scalar, int Dim>
void CompactSplitting<Scalar, Dim>::with_flux(
    const std::function<void(const CellFieldView<Scalar, Dim>&)>& use) const {
  const auto num_cells = static_cast<std::size_t>(problem_.mesh.num_cells());
  AlignedArray<Scalar> flux(num_cells * Dim * stride_);
  std::vector<Scalar> scale(num_cells);
  for (std::size_t s = 0; s < num_cells; ++s) {
    const auto cell = static_cast<Index>(s);
    scale[s] = static_cast<Scalar>(std::sqrt(metric_.cell[cell]) / unit_);
    if (!is_boundary_cell(problem_, cell)) continue;
    const Eigen::Matrix<double, Eigen::Dynamic, Dim> given =
        cell_geometry(problem_.mesh, cell).measure * boundary_flux_density(problem_, cell);
    for (int d = 0; d < Dim; ++d) {
      for (Index i = 0; i < n_; ++i) {
        flux[(s * Dim + d) * stride_ + i] = static_cast<Scalar>(given(i, d));
      }
    }
  }
  const State state = const_cast<CompactSplitting*>(this)->arrays();  // the loop only reads it
  for_slices(state, [&](const State& slice, Columns columns) {
    loops_->flux(slice, columns, scale.data(), flux.data());
  });
  use({flux.data(), stride_, n_});
}

template <class Scalar, int Dim>
Certificate CompactSplitting<Scalar, Dim>::certify(const WeightMatrix& weights) const {
  Certificate certificate;
  with_flux([&](const auto& flux) { certificate = flbc::certify(problem_, flux, weights); });
  return certificate;
}

template <class Scalar, int Dim>
void CompactSplitting<Scalar, Dim>::describe(SolveReport& report) const {
  const auto vertex_numbers = static_cast<double>(rows_.size());
  const double cell_numbers = static_cast<double>(P_.size()) / sizeof(Scalar);
  report.state_scalars_per_cell =
      (vertex_numbers + cell_numbers) / static_cast<double>(stride_) / problem_.mesh.num_cells();
  report.penalty = penalty_;
}

FLBC_INSTANTIATE_SCALAR_CLASS(CompactSplitting)

}  // namespace flbc::compact
