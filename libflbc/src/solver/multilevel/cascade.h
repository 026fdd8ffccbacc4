// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Multilevel start: solves on coarser meshes of the same cage first.
#pragma once

#include <vector>

#include "flbc/observer.h"
#include "solver/methods/method_run.h"
#include "solver/multilevel/coarse_problem.h"

namespace flbc {

//! Solves a problem, starting from the solution on coarser meshes, level by level.
//! \param run  of the problem, not started if there are coarser meshes
//! \param levels  coarsest first; none for a cold start; with levels, the method must satisfy
//! plan::inherits()
//! \param budget  of the run on the mesh of the problem; a start always takes the coarser meshes to
//! their end, so that it does not depend on the budget
//! \param report  of the mesh of the problem, including those of the levels
template <int Dim>
Weights solve_in_cascade(const LbcProblem<Dim>& problem, MethodRun<Dim>& run,
                         std::vector<CoarseProblem<Dim>> levels, const plan::Settings& settings,
                         const Budget& budget, const Reporter& reporter, SolveReport& report);

//! A run with its budget. \param spent  seconds of the budget
template <int Dim>
Weights solve_within(const Budget& budget, double spent, MethodRun<Dim>& run,
                     const plan::Settings& settings, const Reporter& reporter, SolveReport& report,
                     const WarmStart<Dim>& start);

}  // namespace flbc
