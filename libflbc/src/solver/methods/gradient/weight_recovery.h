// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! The weights of the gradient method, wherever it needs them: to start, to stop, and in the end.
#pragma once

#include <optional>

#include "flbc/lbc_problem.h"
#include "flbc/options.h"
#include "problem/laplacian.h"

namespace flbc::gradient {

//! Recovers weights again and again. The Poisson problem of start and recovery is set up once, when
//! it is first needed.
template <int Dim>
class WeightRecovery {
 public:
  //! \param problem  outlives this \param linear_solver  not kAuto
  WeightRecovery(const LbcProblem<Dim>& problem, Recovery recovery, LinearSolver linear_solver)
      : problem_(problem), recovery_(recovery), linear_solver_(linear_solver) {}

  //! Harmonic coordinates, n x V.
  WeightMatrix harmonic();

  //! \param gradients  a vector per cell and control point \return n x V
  template <class Scalar>
  WeightMatrix operator()(const CellFieldView<Scalar, Dim>& gradients);

 private:
  const DirichletProblem<Dim>& poisson();

  const LbcProblem<Dim>& problem_;
  const Recovery recovery_;
  const LinearSolver linear_solver_;
  std::optional<DirichletProblem<Dim>> poisson_;
};

}  // namespace flbc::gradient
