// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! The loop of every iterative method.
#pragma once

#include <limits>

#include "solver/plan/constants.h"
#include "solver/run/iteration.h"
#include "solver/run/reporter.h"
#include "solver/run/stop_rule.h"

namespace flbc {

//! Certifies the weights of an iteration at times that depend only on the number of iterations, so
//! runs are reproducible.
class GapCriterion {
 public:
  //! \param wanted  target relative gap; 0 = never met. The default one also asks for settled weights
  //! (plan::kSettled), unless the gap is very small (plan::kSmallGap).
  explicit GapCriterion(double wanted) : wanted_(wanted) {}

  //! Certifies if due. \param made  iterations of the run \param last  whether this is the last
  //! iteration \param error  estimated error of the weights relative to the tolerance
  //! \return whether the gap is at most the target
  template <int Dim>
  bool is_met(const Iteration<Dim>& iteration, int made, bool last, double error) {
    if (wanted_ == 0 || made < (last ? plan::kFirstCertified : next_)) return false;
    if (!iteration.is_certifiable()) return false;
    next_ = static_cast<int>(plan::kCertifiedGrowth * made);
    const double gap = iteration.certify(iteration.weights().to_dense()).relative_gap;
    const bool waits = wanted_ == plan::kGap && error > plan::kSettled;
    return gap <= (waits ? plan::kSmallGap : wanted_);
  }

 private:
  double wanted_;
  int next_ = plan::kFirstCertified;
};

//! Inputs of a run other than the iteration. Keeps references.
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
//! \param pause  iteration after which to pause, so another method can take over
//! \param report  receives iterations, status, criterion, and residuals; the iteration count
//! continues
//! \return whether the run has ended; otherwise it pauses
//! \throws SolverError if numbers are not finite
template <int Dim>
bool run(Iteration<Dim>& iteration, const RunContext<Dim>& context, SolveReport& report,
         int pause = std::numeric_limits<int>::max());

//! Extreme penalties and relaxations cause overflow, which must never be returned as a result.
//! \throws SolverError unless `finite`
void require_finite(bool finite, const SolveReport& report);

//! The objective in the units of the given mesh.
template <int Dim>
double unscaled(const LbcProblem<Dim>& problem, double objective);

}  // namespace flbc
