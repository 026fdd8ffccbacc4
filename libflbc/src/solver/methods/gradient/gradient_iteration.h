// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Methods kGradient and kPaper: the gradient ADMM with its starts and the recovery of weights.
#pragma once

#include <optional>

#include "coordinates/poisson_weights.h"
#include "flbc/options.h"
#include "solver/methods/gradient/gradient_admm.h"
#include "solver/run/iteration.h"

namespace flbc::gradient {

//! What the iteration needs besides its problem.
struct Settings {
  double penalty = 1;     //!< mu > 0
  double relaxation = 1;  //!< in (0, 2), 1 for the paper's iteration
  bool harmonic = false;  //!< starts from harmonic coordinates, else from the least-norm solution
  Recovery recovery = Recovery::kLeastSquares;
  LinearSolver linear_solver = LinearSolver::kDirect;  //!< of start and recovery
};

template <class Scalar, int Dim>
class GradientIteration final : public Iteration<Dim> {
 public:
  GradientIteration(const LbcProblem<Dim>& problem, const Settings& settings);

  //! Cold, as settings say: no other iteration hands over to this one.
  void start(const Start<Dim>& start) override;
  Step iterate(int count, bool measure) override;
  //! Recovered from the present gradients; before the first iteration those of a harmonic start.
  Weights weights() const override;
  void read_weights(Index vertex, double* weights) const override;
  Certificate certify(const WeightMatrix& weights) const override;
  void describe(SolveReport& report) const override;

 private:
  const DirichletProblem<Dim>& poisson() const;

  const LbcProblem<Dim>& problem_;
  const Settings settings_;
  GradientAdmm<Scalar, Dim> admm_;
  mutable std::optional<DirichletProblem<Dim>> poisson_;  // of start and recovery, once needed
  WeightMatrix start_weights_;                            // until the first iteration
};

}  // namespace flbc::gradient
