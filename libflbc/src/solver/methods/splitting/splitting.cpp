// SPDX-License-Identifier: BSD-3-Clause
#include "solver/methods/splitting/splitting.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/instantiate.h"
#include "base/parallel.h"
#include "problem/boundary_flux.h"

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
      penalty_(parameters.part * parameters.penalty) {
}

// Calls body(control point, place) for the values of a vertex.
template <class Scalar, int Dim>
template <class Body>
void Splitting<Scalar, Dim>::for_row(Index vertex, const Body& body) const {
  const auto [first, count, items] = row(data_.row_of[vertex]);
  for (Index j = 0; j < count; ++j) body(items == nullptr ? j : Index{items[j]}, first + j);
}

template <class Scalar, int Dim>
Step Splitting<Scalar, Dim>::iterate(int made, int count) {
  const auto iterate_once = [this] {
    solve(kernel_.z_step, parameters_.relaxation);
    return pass_rows(kernel_.y_step) / (sigma() * sigma());
  };
  for (int k = 1; k < count; ++k) iterate_once();
  const bool measures = parameters_.paper_residuals && (made + count) % interval() == 0;
  if (!measures) return {iterate_once()};
  // The w_step waits until the residuals are measured.
  const auto before = rows_.w();
  Step step{rows_.without_dual(iterate_once)};
  measure_paper_residuals(rows_.moved(before), step);
  pass_rows(kernel_.w_step);
  return step;
}

// r_p is the violation of the constraints, r_d = rho times the change of the gradients and the
// weights in an iteration, both in the metric. \param moved  the change of w
template <class Scalar, int Dim>
void Splitting<Scalar, Dim>::measure_paper_residuals(const AlignedArray<Scalar>& moved,
                                                     Step& step) {
  rows_.set_difference();
  const auto of_cells = cell_residuals(moved);
  double moved_rows = 0;
  double violation = of_cells.violation;
  for (std::size_t k = 0; k < data_.vertex_metric.size(); ++k) {
    const auto metric = static_cast<double>(data_.vertex_metric[k]);
    for_row(data_.vertices[k], [&](Index, std::size_t j) {
      const double w = 0.5 * (static_cast<double>(rows_.a[j]) + static_cast<double>(rows_.W[j]));
      const double u =
          std::max(0.0, static_cast<double>(rows_.a[j]) - static_cast<double>(rows_.S[j]));
      violation += metric * (u - w) * (u - w);
      moved_rows += metric * static_cast<double>(moved[j]) * static_cast<double>(moved[j]);
    });
  }
  const double components = static_cast<double>(problem_.mesh.num_cells()) * Dim +
                            static_cast<double>(data_.vertex_metric.size());
  step.primal = std::sqrt(violation) / sigma() / (components * n_);
  step.dual = penalty_ * std::sqrt(of_cells.motion + moved_rows) / sigma() / (components * n_);
}

// ---- starts -------------------------------------------------------------------------------------

template <class Scalar, int Dim>
void Splitting<Scalar, Dim>::start(const Start<Dim>& start) {
  set_weights(start.weights);
  std::copy_n(rows_.a.data(), rows_.W.size(), rows_.W.data());
  set_cell_dual(start.flux_density);
  set_vertex_dual(start.vertex_dual_at(penalty_));
  solve(kernel_.z_step, 0);
  pass_rows(kernel_.correct);
  parallel_for(rows_.W.size(), [&](std::size_t k) { rows_.W[k] = 2 * rows_.W[k] - rows_.a[k]; });
  pass_rows(kernel_.w_step);
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
