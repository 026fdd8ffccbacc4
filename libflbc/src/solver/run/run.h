// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! The loop of every iterative method.
#pragma once

#include "solver/plan/constants.h"
#include "solver/plan/settings.h"
#include "solver/run/iteration.h"
#include "solver/run/reporter.h"
#include "solver/run/stop_rule.h"

namespace flbc {

//! Certifies the weights of an iteration at times that depend only on the number of iterations, so
//! runs are reproducible.
class GapCriterion {
 public:
  //! Certifies if due. \param target  relative gap, 0 for none \param made  iterations since the
  //! start
  //! \return whether the target is met
  template <int Dim>
  bool is_met(double target, const Iteration<Dim>& iteration, int made) {
    if (target == 0 || made < next_ || !iteration.can_certify()) return false;
    next_ = static_cast<int>(plan::kCertifiedGrowth * made);
    return iteration.certify(iteration.weights().to_dense(), nullptr).relative_gap <= target;
  }

 private:
  int next_ = plan::kFirstCertified;
};

//! The state of a run besides its iteration. A run that resumes keeps it, so iterations are counted
//! and judged as if it had never been interrupted.
struct RunState {
  StopRule stop;
  GapCriterion gap{};
  int made = 0;   //!< iterations since the start
  int begun = 0;  //!< iterations before those on the present pairs
};

//! Inputs of a run other than the iteration and its state. Keeps references.
template <int Dim>
struct RunContext {
  const LbcProblem<Dim>& problem;
  const plan::Settings& settings;  //!< resolved
  const Reporter& reporter;
};

//! Iterates until the stop rule or the certified gap is met, the limit of iterations is reached, or
//! the caller stops it. \param report  receives iterations of this call, status, criterion, and
//! residuals
//! \throws SolverError if numbers are not finite
template <int Dim>
void run(Iteration<Dim>& iteration, RunState& state, const RunContext<Dim>& context,
         SolveReport& report);

//! Extreme penalties and relaxations cause overflow, which must never be returned as a result.
//! \throws SolverError unless `finite`
void require_finite(bool finite, const SolveReport& report);

//! The objective in the units of the given mesh.
template <int Dim>
double unscaled(const LbcProblem<Dim>& problem, double objective);

}  // namespace flbc
