// SPDX-License-Identifier: BSD-3-Clause
#include "solver/run/run.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "base/instantiate.h"
#include "base/parallel.h"
#include "base/stopwatch.h"
#include "flbc/errors.h"
#include "flbc/quality.h"
#include "solver/run/thread_choice.h"

namespace flbc {
namespace {

template <int Dim>
Progress progress_of(const Iteration<Dim>& iteration, const LbcProblem<Dim>& problem,
                     const SolveReport& report) {
  Progress progress{report.iterations, report.relative_primal_residual,
                    report.relative_dual_residual};
  progress.objective = [&] {
    return unscaled(problem, objective(problem, iteration.weights().to_sparse()));
  };
  return progress;
}

// Ends the run or reports progress, if due. Sets status and criterion. \param last  whether the
// limit is reached \return whether to end
template <int Dim>
bool is_finished(const Iteration<Dim>& iteration, RunState<Dim>& state,
                 const RunContext<Dim>& context, bool last, SolveReport& report) {
  const bool converged = report.relative_primal_residual <= 1 && report.relative_dual_residual <= 1;
  const bool due = converged ? state.made >= std::max(plan::kFewestIterations, state.earliest)
                             : state.made % plan::kCheckInterval == 0;
  if (!due && !last) return false;
  report.status = SolveStatus::kConverged;
  report.criterion = Criterion::kTolerance;
  if (converged) return true;
  report.criterion = Criterion::kGap;
  if (state.gap.is_met(context.settings, iteration, state.made, last,
                       report.relative_primal_residual)) {
    return true;
  }
  report.criterion = Criterion::kNone;
  report.status = SolveStatus::kIterationLimit;
  if (last) return true;
  report.status = SolveStatus::kStopped;
  return context.reporter.listens() &&
         !context.reporter.progress(progress_of(iteration, context.problem, report));
}

}  // namespace

void require_finite(bool finite, const SolveReport& report) {
  if (finite) return;
  throw SolverError("the computation broke down within " + std::to_string(report.iterations) +
                    " iterations: its numbers are not finite; try the default penalty and "
                    "relaxation, or double precision");
}

template <int Dim>
double unscaled(const LbcProblem<Dim>& problem, double objective) {
  return objective / std::pow(problem.scale, Dim - 1);
}

template <int Dim>
void run(Iteration<Dim>& iteration, RunState<Dim>& state, const RunContext<Dim>& context,
         SolveReport& report) {
  const double tolerance = *context.settings.tolerance;
  const int before = state.made;
  const int limit =
      before + std::min(context.settings.max_iterations, std::numeric_limits<int>::max() - before);
  const int interval = state.stop->interval();
  ThreadChoice choice(omp_get_max_threads());
  while (state.made < limit) {
    context.reporter.poll();
    const int until = std::min(interval - state.made % interval, limit - state.made);
    const int count = context.reporter.has_limit() ? 1 : until;
    Step step;
    {
      const ThreadScope scope(choice.threads());
      const double on_core = seconds_on_core();
      Stopwatch watch;
      step = iteration.iterate(state.made, count, state.stop->wants_residuals());
      choice.note(count, watch.lap(), seconds_on_core() - on_core);
    }
    state.made += count;
    report.iterations = state.made - before;
    const bool is_late = context.reporter.is_late();
    if (count < until) {
      if (is_late) break;
      continue;
    }
    const auto [primal, dual] = state.stop->judge(step, iteration, state.made, tolerance);
    report.relative_primal_residual = primal;
    report.relative_dual_residual = dual;
    require_finite(std::isfinite(primal) && std::isfinite(dual), report);
    const bool ends = is_finished(iteration, state, context, state.made == limit, report);
    const bool converged = ends && report.status == SolveStatus::kConverged;
    const int to_make = iteration.adapt(
        {state.made, step, tolerance * std::max(primal, 1.0), tolerance, converged});
    if (to_make > 0) state.earliest = state.made + to_make;
    if (ends && !(converged && to_make > 0)) return;
    if (is_late) break;
  }
  report.status = SolveStatus::kIterationLimit;
  report.criterion = Criterion::kNone;
}

FLBC_INSTANTIATE_FUNCTION(unscaled)
FLBC_INSTANTIATE_FUNCTION(run)

}  // namespace flbc
