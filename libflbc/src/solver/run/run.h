// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! The loop of every iterative method.
#pragma once

#include <limits>

#include "solver/run/gap_criterion.h"
#include "solver/run/iteration.h"
#include "solver/run/reporter.h"
#include "solver/run/stop_rule.h"

namespace flbc {

//! What a run reads besides the iteration. Keeps references.
template <int Dim>
struct RunContext {
  const LbcProblem<Dim>& problem;
  const SolverOptions& options;  //!< resolved
  StopRule<Dim>& stop;
  GapCriterion& gap;
  const Reporter& reporter;
};

//! Iterates until the stop rule or the certified gap is met, the limit of iterations is reached, or
//! the caller stops it.
//! \param pause  iteration after which another iteration is to take over
//! \param report  gets iterations, status, criterion and residuals; goes on counting iterations
//! \return whether the run has ended; otherwise it pauses
//! \throws SolverError if numbers are not finite
template <int Dim>
bool run(Iteration<Dim>& iteration, const RunContext<Dim>& context, SolveReport& report,
         int pause = std::numeric_limits<int>::max());

//! Penalties and relaxations out of proportion take the numbers out of their range, which must
//! never pass for a result. \throws SolverError unless `finite`
void require_finite(bool finite, const SolveReport& report);

//! An objective in the units of the mesh as it was given.
template <int Dim>
double unscaled(const LbcProblem<Dim>& problem, double objective);

}  // namespace flbc
