// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Where an iteration on supports starts from without a coarser mesh.
#pragma once

#include "flbc/lbc_problem.h"
#include "flbc/linear_solver.h"
#include "solver/warm_start/dual_start.h"

namespace flbc::supports {

//! Harmonic coordinates, without duals. \param linear_solver  for the Laplace equation
//! \throws SolverError if it cannot be solved
template <int Dim>
DualStart<Dim> cold_start(const LbcProblem<Dim>& problem, LinearSolver linear_solver);

}  // namespace flbc::supports
