// SPDX-License-Identifier: BSD-3-Clause
#include "solver/methods/splitting/splitting.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/instantiate.h"
#include "base/parallel.h"
#include "problem/boundary_flux.h"
#include "solver/plan/constants.h"

namespace flbc::splitting {

template <class Scalar, int Dim>
Splitting<Scalar, Dim>::Splitting(const LbcProblem<Dim>& problem, Metric metric,
                                  const Parameters& parameters,
                                  const compact::Kernel<Scalar, Dim>& kernel)
    : problem_(problem),
      kernel_(kernel),
      parameters_(parameters),
      n_(problem.num_control_points()),
      metric_(std::move(metric)),
      unit_(compact::radius_unit(problem, metric_)),
      loops_(parameters.half ? &kernel.half : &kernel.exact),
      penalty_(parameters.part * parameters.penalty),
      rule_(parameters.balances, parameters.looks, problem.smoothness, parameters.part) {
}

// Calls body(control point, place) for the values of a vertex.
template <class Scalar, int Dim>
template <class Body>
void Splitting<Scalar, Dim>::for_row(Index vertex, const Body& body) const {
  const auto [first, count, items] = row(data_.row_of[vertex]);
  for (Index j = 0; j < count; ++j) body(items == nullptr ? j : Index{items[j]}, first + j);
}

// z_step and solve for all cells, then y_step for all rows, with the next iteration's w_step.
template <class Scalar, int Dim>
Step Splitting<Scalar, Dim>::iterate(int made, int count, bool measure) {
  const double relaxation = parameters_.relaxation;
  for (int k = 1; k < count; ++k) {
    solve(loops_->z_step, relaxation);
    pass_rows(loops_->y_step);
  }
  const auto due = rule_.due(made + count);
  const bool looks = due == Due::kLook;
  const bool paper = looks || (measure && parameters_.paper_residuals);
  const bool measured = measure || looks;
  AlignedArray<Scalar> w;
  if (paper) w = all_rows_of_w();
  if (measured) rows_.set_difference();
  const double of_cells = solve(measured ? loops_->z_step_measured : loops_->z_step, relaxation);
  const auto sums = rows_.with_dual(due != Due::kNothing, measured, [&] {
    return pass_rows(measured ? loops_->y_step_measured : loops_->y_step);
  });
  const double scale = 1 / (sigma() * sigma());
  if (!measured) return {scale * sums.change};
  Step step{scale * sums.change, scale * (of_cells + sums.violation)};
  if (paper) {
    measure_paper_residuals(std::move(w), looks ? scale * of_cells : step.violation, step);
  }
  return step;
}

// w of the interior rows; zero on the boundary, where it does not change.
template <class Scalar, int Dim>
AlignedArray<Scalar> Splitting<Scalar, Dim>::all_rows_of_w() const {
  AlignedArray<Scalar> w(rows_.a.size());
  parallel_for(rows_.W.size(),
               [&](std::size_t k) { w[k] = Scalar(0.5) * (rows_.a[k] + rows_.W[k]); });
  return w;
}

// r_p is the violation of the constraints, r_d = rho times the change of the gradients and the
// weights in an iteration, both in the metric. \param moved  w before the iteration
// \param violation  squared; a look takes that of the gradients
template <class Scalar, int Dim>
void Splitting<Scalar, Dim>::measure_paper_residuals(AlignedArray<Scalar> moved, double violation,
                                                     Step& step) {
  const auto after = all_rows_of_w();
  parallel_for(moved.size(), [&](std::size_t k) { moved[k] = after[k] - moved[k]; });
  double of_rows = 0;
  for (std::size_t k = 0; k < data_.vertex_metric.size(); ++k) {
    for_row(data_.vertices[k], [&](Index, std::size_t place) {
      const auto delta = static_cast<double>(moved[place]);
      of_rows += static_cast<double>(data_.vertex_metric[k]) * delta * delta;
    });
  }
  const double of_cells = squared_lengths(moved).motion2;
  const double components = static_cast<double>(problem_.mesh.num_cells()) * Dim +
                            static_cast<double>(data_.vertex_metric.size());
  step.primal = std::sqrt(violation) / (components * n_);
  step.dual = penalty_ * std::sqrt(of_cells + of_rows) / sigma() / (components * n_);
}

template <class Scalar, int Dim>
void Splitting<Scalar, Dim>::set_penalty(double penalty) {
  rows_.scale_interior(static_cast<Scalar>(penalty / penalty_));
  penalty_ = penalty;
}

template <class Scalar, int Dim>
int Splitting<Scalar, Dim>::adapt(const Milestone& at) {
  if (const auto due = rule_.due(at.made); due != Due::kNothing) {
    set_penalty(due == Due::kBalance
                    ? rule_.balanced(penalty_, squared_lengths(rows_.moved()))
                    : rule_.after_look(at.made, penalty_, at.step.primal / at.step.dual));
    pass_rows(loops_->w_step);
  }
  const int until_settled = extend(at);
  if (stores_half() && plan::ends_half_precision(at.made, at.error)) store_in_single();
  return std::max(until_settled, rule_.to_make(at.made));
}

template <class Scalar, int Dim>
void Splitting<Scalar, Dim>::store_in_single() {
  const std::size_t size = P_.size() / loops_->bytes;
  AlignedArray<unsigned char> exact(size * sizeof(Scalar));
  loops_->decode(P_.data(), 0, reinterpret_cast<Scalar*>(exact.data()), size);
  P_ = std::move(exact);
  loops_ = &kernel_.exact;
  set_radii();
}

// ---- starts -------------------------------------------------------------------------------------

template <class Scalar, int Dim>
void Splitting<Scalar, Dim>::start(const Start<Dim>& start) {
  set_weights(start.weights);
  std::copy_n(rows_.a.data(), rows_.W.size(), rows_.W.data());
  set_cell_dual(start.flux_density);
  set_vertex_dual(start.vertex_dual_at(penalty_));
  solve(loops_->z_step, 0);
  pass_rows(loops_->correct);
  parallel_for(rows_.W.size(), [&](std::size_t k) { rows_.W[k] = 2 * rows_.W[k] - rows_.a[k]; });
  pass_rows(loops_->w_step);
  if (parameters_.balances) rows_.keep_start();
}

template <class Scalar, int Dim>
void Splitting<Scalar, Dim>::set_weights(const VectorsAt<1>& weights) {
  const auto of_vertex = with_known_values(problem_, weights);
  parallel_for(problem_.mesh.num_vertices(), [&](Index v) {
    const Eigen::VectorXd at_vertex = of_vertex(v);
    for_row(v, [&](Index i, std::size_t place) {
      rows_.a[place] = static_cast<Scalar>(sigma() * at_vertex[i]);
    });
  });
}

// S, and the vertex part of the right-hand side, which an iteration prepares for the next one.
template <class Scalar, int Dim>
void Splitting<Scalar, Dim>::set_vertex_dual(const VectorsAt<1>& vertex_dual) {
  std::fill_n(rows_.S.data(), rows_.S.size(), Scalar(0));
  std::fill_n(rows_.residual.data(), rows_.residual.size(), Scalar(0));
  if (rows_.S.size() == 0 || !vertex_dual) return;
  parallel_for(data_.vertices.size(), [&](std::size_t k) {
    const Eigen::VectorXd at_vertex = vertex_dual(data_.vertices[k]);
    for_row(data_.vertices[k], [&](Index i, std::size_t place) {
      rows_.S[place] = static_cast<Scalar>(sigma() * at_vertex[i]);
      rows_.residual[place] = data_.vertex_metric[k] * rows_.S[place];
    });
  });
}

// ---- results ------------------------------------------------------------------------------------

template <class Scalar, int Dim>
void Splitting<Scalar, Dim>::read_weights(Index vertex, double* weights) const {
  const auto half = static_cast<Scalar>(0.5 / sigma());
  std::fill_n(weights, n_, 0.0);
  for_row(vertex, [&](Index i, std::size_t place) {
    weights[i] = half * (rows_.a[place] + rows_.W[place]);
  });
}

template <class Scalar, int Dim>
Start<Dim> Splitting<Scalar, Dim>::state() const {
  Start<Dim> start;
  start.penalty = penalty_ / parameters_.part;
  start.weights = [this](Index v) {
    Eigen::VectorXd weights(n_);
    read_weights(v, weights.data());
    return weights;
  };
  start.flux_density = [this](Index s) { return flux_density(s); };
  if (rows_.S.size() > 0) start.vertex_dual = [this](Index v) { return vertex_dual_at(v); };
  return start;
}

// q - w of an interior vertex for the penalty of state(), n numbers.
template <class Scalar, int Dim>
Eigen::VectorXd Splitting<Scalar, Dim>::vertex_dual_at(Index vertex) const {
  Eigen::VectorXd dual = Eigen::VectorXd::Zero(n_);
  for_row(vertex, [&](Index i, std::size_t place) {
    dual[i] = parameters_.part * (rows_.vertex_dual(place) / sigma());
  });
  return dual;
}

template <class Scalar, int Dim>
Vectors<Dim> Splitting<Scalar, Dim>::flux_density(Index cell) const {
  if (is_boundary_cell(problem_, cell)) return boundary_flux_density(problem_, cell);
  Vectors<Dim> density = cell_dual(cell);
  density *= 1 / compact::dual_scale(problem_, metric_, unit_, cell);
  make_admissible(problem_, cell, density);
  return density;
}

FLBC_INSTANTIATE_SCALAR_CLASS(Splitting)

}  // namespace flbc::splitting
