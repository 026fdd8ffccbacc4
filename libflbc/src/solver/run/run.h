// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! The loop of every iterative method.
#pragma once

#include <memory>

#include "solver/run/gap_criterion.h"
#include "solver/run/iteration.h"
#include "solver/run/reporter.h"
#include "solver/run/stop_rule.h"

namespace flbc {

//! The state of a run besides its iteration. A run that resumes keeps it, so iterations are counted
//! and judged as if it had never been interrupted.
template <int Dim>
struct RunState {
  std::unique_ptr<StopRule<Dim>> stop;
  GapCriterion gap{};
  int made = 0;      //!< iterations since the start
  int earliest = 0;  //!< the run must not end before this iteration
};

//! Inputs of a run other than the iteration and its state. Keeps references.
template <int Dim>
struct RunContext {
  const LbcProblem<Dim>& problem;
  const plan::Settings& settings;  //!< resolved
  const plan::GapTarget gap;       //!< instead of that of the settings
  const Reporter& reporter;
};

//! Iterates until the stop rule or the certified gap is met, the limit of iterations is reached, or
//! the caller stops it. \param report  receives iterations of this call, status, criterion, and
//! residuals
//! \throws SolverError if numbers are not finite
template <int Dim>
void run(Iteration<Dim>& iteration, RunState<Dim>& state, const RunContext<Dim>& context,
         SolveReport& report);

//! Extreme penalties and relaxations cause overflow, which must never be returned as a result.
//! \throws SolverError unless `finite`
void require_finite(bool finite, const SolveReport& report);

//! The objective in the units of the given mesh.
template <int Dim>
double unscaled(const LbcProblem<Dim>& problem, double objective);

}  // namespace flbc
