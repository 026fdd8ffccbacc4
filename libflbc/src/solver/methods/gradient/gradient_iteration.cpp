// SPDX-License-Identifier: BSD-3-Clause
#include "solver/methods/gradient/gradient_iteration.h"

#include "flbc/recovery.h"

namespace flbc::gradient {

template <class Scalar, int Dim>
GradientIteration<Scalar, Dim>::GradientIteration(const LbcProblem<Dim>& problem,
                                                  const Settings& settings)
    : problem_(problem),
      settings_(settings),
      admm_(problem, settings.penalty, settings.relaxation,
            boundary_periods(problem, settings.linear_solver)) {
}

template <class Scalar, int Dim>
const DirichletProblem<Dim>& GradientIteration<Scalar, Dim>::poisson() const {
  if (!poisson_) poisson_.emplace(problem_.mesh, problem_.boundary, settings_.linear_solver);
  return *poisson_;
}

template <class Scalar, int Dim>
void GradientIteration<Scalar, Dim>::start(const Start<Dim>&) {
  if (!settings_.harmonic) {
    admm_.start_from_least_norm();
    return;
  }
  start_weights_ = harmonic_coordinates(problem_, poisson());
  admm_.start_from_weights(start_weights_);
}

template <class Scalar, int Dim>
Step GradientIteration<Scalar, Dim>::iterate(int count, bool) {
  start_weights_ = {};
  const Change change = admm_.iterate(count);
  const auto residuals = admm_.residuals(change);
  const double components = admm_.num_residual_components();
  return {change.gradient, change.dual, residuals.primal / components, residuals.dual / components};
}

template <class Scalar, int Dim>
Weights GradientIteration<Scalar, Dim>::weights() const {
  if (start_weights_.size() > 0) return {start_weights_, {}};
  if (settings_.recovery == Recovery::kBreadthFirst) {
    return {integrate_breadth_first(problem_, admm_.gradients()), {}};
  }
  return {integrate_least_squares(problem_, admm_.gradients(), poisson()), {}};
}

template <class Scalar, int Dim>
void GradientIteration<Scalar, Dim>::read_weights(Index vertex, double* weights) const {
  const auto all = this->weights().dense;
  Eigen::Map<Eigen::VectorXd>(weights, all.rows()) = all.col(vertex);
}

template <class Scalar, int Dim>
Certificate GradientIteration<Scalar, Dim>::certify(const WeightMatrix& weights) const {
  return flbc::certify(problem_, admm_.flux(), weights);
}

template <class Scalar, int Dim>
void GradientIteration<Scalar, Dim>::describe(SolveReport& report) const {
  report.penalty = settings_.penalty;
  report.state_scalars_per_cell = admm_.state_scalars_per_cell();
}

template class GradientIteration<float, 2>;
template class GradientIteration<float, 3>;
template class GradientIteration<double, 2>;
template class GradientIteration<double, 3>;

}  // namespace flbc::gradient
