// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Solving on coarser meshes of the same cage first, to start from there.
#pragma once

#include <vector>

#include "solver/methods/method_run.h"
#include "solver/multilevel/coarse_problem.h"

namespace flbc {

//! Solves a problem from the solution on coarser meshes, each from that of the one before.
//! \param run  of the problem, not begun if there are coarser meshes
//! \param levels  coarsest first; none for a cold start
//! \param options  resolved, of a method that plan::inherits() holds for if there are levels
//! \param report  of the problem's own mesh, with those of the levels
template <int Dim>
Weights solve_in_cascade(const LbcProblem<Dim>& problem, MethodRun<Dim>& run,
                         std::vector<CoarseProblem<Dim>> levels, const SolverOptions& options,
                         const Reporter& reporter, SolveReport& report);

}  // namespace flbc
