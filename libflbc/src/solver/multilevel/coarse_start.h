// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Starts a solve from the solution on the coarse mesh.
#pragma once

#include "flbc/options.h"
#include "solver/methods/method_run.h"
#include "solver/multilevel/coarse_problem.h"

namespace flbc {

//! Solves the coarse problem, and from its weights and duals the problem itself.
//! \param run  of the problem, not begun
//! \param coarse  released when the iteration on the problem has started; null for a cold start
//! \param given  start from this, and take only supports from the coarse problem; or null
//! \param budget  of the run on the problem; the coarse mesh is always solved to the end, so that
//! the start does not depend on the budget
//! \param report  of the problem, including the coarse mesh
template <int Dim>
Weights solve_from_coarse(const LbcProblem<Dim>& problem, MethodRun<Dim>& run,
                          std::optional<CoarseProblem<Dim>> coarse, const Prolongation<Dim>* given,
                          const plan::Settings& settings, const Budget& budget,
                          const Reporter& reporter, SolveReport& report);

//! A run with its budget. \param spent  seconds of the budget
template <int Dim>
Weights solve_within(const Budget& budget, double spent, MethodRun<Dim>& run,
                     const plan::Settings& settings, const Reporter& reporter, SolveReport& report,
                     const RunStart<Dim>& start);

}  // namespace flbc
