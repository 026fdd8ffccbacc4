// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Where an iteration on supports starts from without a coarser mesh.
#pragma once

#include <memory>

#include "flbc/lbc_problem.h"
#include "flbc/types.h"
#include "solver/supports/support_lists.h"
#include "solver/warm_start/dual_start.h"

namespace flbc::supports {

//! Harmonic coordinates and their supports, without duals.
template <int Dim>
struct ColdStart {
  std::shared_ptr<const Eigen::MatrixXf> weights;  //!< n x V, more than exact enough for a start
  SupportLists supports;

  //! In the form that other starts have.
  DualStart<Dim> state() const;
};

//! \param problem  without phi as well \param linear_solver  for the Laplace equation
//! \throws SolverError if it cannot be solved
template <int Dim>
ColdStart<Dim> cold_start(const LbcProblem<Dim>& problem, LinearSolver linear_solver);

}  // namespace flbc::supports
