// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Everything after the iteration.
#pragma once

#include "flbc/solver.h"
#include "solver/methods/method_run.h"

namespace flbc {

//! Makes a solution of the weights that a run has left: non-negative rows, certificate, measures.
//! \param options  resolved
template <int Dim>
Solution finish(const LbcProblem<Dim>& problem, const MethodRun<Dim>& run, Weights weights,
                const SolverOptions& options, const Reporter& reporter, SolveReport report);

}  // namespace flbc
