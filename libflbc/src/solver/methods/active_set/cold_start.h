// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Where an iteration on the active set starts from without a coarser mesh.
#pragma once

#include <memory>

#include "flbc/lbc_problem.h"
#include "flbc/types.h"
#include "solver/methods/active_set/active_lists.h"
#include "solver/start/start.h"

namespace flbc::active_set {

//! Harmonic coordinates and their active set, without duals.
template <int Dim>
struct ColdStart {
  std::shared_ptr<const Eigen::MatrixXf> weights;  //!< n x V, more than exact enough for a start
  ActiveLists active;

  //! In the form that other starts have.
  Start<Dim> state() const;
};

//! \param problem  without phi as well \param linear_solver  for the Laplace equation
//! \throws SolverError if it cannot be solved
template <int Dim>
ColdStart<Dim> cold_start(const LbcProblem<Dim>& problem, LinearSolver linear_solver);

}  // namespace flbc::active_set
