// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Multilevel start: solves on coarser meshes of the same cage first.
#pragma once

#include <vector>

#include "solver/methods/method_run.h"
#include "solver/multilevel/coarse_problem.h"

namespace flbc {

//! Solves a problem, starting from the solution on coarser meshes, level by level.
//! \param run  of the problem, not started if there are coarser meshes
//! \param levels  coarsest first; none for a cold start
//! ; with levels, the method must satisfy plan::inherits()
//! \param report  of the mesh of the problem, including those of the levels
template <int Dim>
Weights solve_in_cascade(const LbcProblem<Dim>& problem, MethodRun<Dim>& run,
                         std::vector<CoarseProblem<Dim>> levels, const plan::Settings& settings,
                         const Reporter& reporter, SolveReport& report);

}  // namespace flbc
