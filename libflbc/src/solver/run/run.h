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

//! Certifies the weights of an iteration from time to time. The number of iterations alone decides
//! when, so that runs are repeatable.
class GapCriterion {
 public:
  //! \param wanted  relative gap, 0 = none is small enough
  explicit GapCriterion(double wanted) : wanted_(wanted) {}

  //! Certifies if it is time to. \param made  iterations of the run \param last  whether no other
  //! follows \return whether the gap is proved to be at most the one wanted
  template <int Dim>
  bool is_met(const Iteration<Dim>& iteration, int made, bool last) {
    if (wanted_ == 0 || made < (last ? plan::kFirstCertified : next_)) return false;
    if (!iteration.is_certifiable()) return false;
    next_ = static_cast<int>(plan::kCertifiedGrowth * made);
    return iteration.certify(iteration.weights().to_dense()).relative_gap <= wanted_;
  }

 private:
  double wanted_;
  int next_ = plan::kFirstCertified;
};

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
