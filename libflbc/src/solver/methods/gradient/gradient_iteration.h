// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Methods kGradient and kPaper: the gradient ADMM with its starts and recovery.
#pragma once

#include <optional>

#include "coordinates/poisson_weights.h"
#include "flbc/recovery.h"
#include "solver/methods/gradient/gradient_admm.h"
#include "solver/plan/constants.h"
#include "solver/plan/settings.h"
#include "solver/run/iteration.h"

namespace flbc::gradient {

//! Parameters of the iteration.
struct Parameters {
  double penalty = 1;     //!< mu > 0
  double relaxation = 1;  //!< in (0, 2), 1 for the iteration of the paper
  //! Starts from the least-norm solution and recovers weights breadth-first, as in the paper,
  //! instead of harmonic coordinates and least squares.
  bool as_published = false;
  LinearSolver linear_solver = LinearSolver::kDirect;  //!< of start and recovery
};

template <class Scalar, int Dim>
class GradientIteration final : public Iteration<Dim> {
 public:
  GradientIteration(const LbcProblem<Dim>& problem, const Parameters& parameters)
      : problem_(problem),
        parameters_(parameters),
        admm_(problem, parameters.penalty, parameters.relaxation,
              boundary_periods(problem, parameters.linear_solver)) {}

  //! Starts cold, as in the parameters; no other iteration hands over to this one.
  void start(const Start<Dim>&) override {
    if (parameters_.as_published) {
      admm_.start_from_least_norm();
      return;
    }
    start_weights_ = harmonic_coordinates(problem_, poisson());
    admm_.start_from_weights(start_weights_);
  }

  int interval() const override { return plan::kCheckInterval; }

  Step iterate(int, int count) override {
    start_weights_ = {};
    const Change change = admm_.iterate(count);
    const auto residuals = admm_.residuals(change);
    const double components = admm_.num_residual_components();
    return {change.gradient, residuals.primal / components, residuals.dual / components};
  }

  //! Recovers weights from the current gradients; before the first iteration, returns those of a
  //! harmonic start.
  Weights weights() const override {
    if (start_weights_.size() > 0) return {start_weights_, {}};
    if (parameters_.as_published) {
      return {integrate_breadth_first(problem_, admm_.gradients()), {}};
    }
    return {integrate_least_squares(problem_, admm_.gradients(), poisson()), {}};
  }

  Certificate certify(const WeightMatrix& weights, Proof* proof) const override {
    return flbc::certify(problem_, admm_.flux(), weights, proof);
  }

  void describe(SolveReport& report) const override {
    report.penalty = parameters_.penalty;
    report.state_scalars_per_cell = admm_.state_scalars_per_cell();
  }

 private:
  const DirichletProblem<Dim>& poisson() const {
    if (!poisson_) poisson_.emplace(problem_.mesh, problem_.boundary, parameters_.linear_solver);
    return *poisson_;
  }

  const LbcProblem<Dim>& problem_;
  const Parameters parameters_;
  GradientAdmm<Scalar, Dim> admm_;
  mutable std::optional<DirichletProblem<Dim>> poisson_;  // for start and recovery, made on demand
  WeightMatrix start_weights_;                            // until the first iteration
};

}  // namespace flbc::gradient
