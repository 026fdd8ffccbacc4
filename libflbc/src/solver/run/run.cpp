// SPDX-License-Identifier: BSD-3-Clause
#include "solver/run/run.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "base/instantiate.h"
#include "flbc/errors.h"
#include "flbc/quality.h"

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

// Whether the run ends at an evaluation: sets status and criterion. Reports progress, if due.
template <int Dim>
bool is_finished(const Iteration<Dim>& iteration, RunState& state, const RunContext<Dim>& context,
                 SolveReport& report) {
  const bool converged = !context.settings.ends_by_gap && report.relative_primal_residual <= 1 &&
                         report.relative_dual_residual <= 1 &&
                         state.made - state.begun >= plan::kFewestIterations;
  if (converged || state.gap.is_met(*context.settings.gap, iteration, state.made)) {
    report.status = SolveStatus::kConverged;
    report.criterion = converged ? Criterion::kTolerance : Criterion::kGap;
    return true;
  }
  const bool stopped = state.made % plan::kCheckInterval == 0 && context.reporter.listens() &&
                       !context.reporter.progress(progress_of(iteration, context.problem, report));
  if (stopped) report.status = SolveStatus::kStopped;
  return stopped;
}

}  // namespace

void require_finite(bool finite, const SolveReport& report) {
  if (finite) return;
  throw SolverError("the computation broke down within " + std::to_string(report.iterations) +
                    " iterations: its numbers are not finite; try the default penalty, or "
                    "double precision");
}

template <int Dim>
double unscaled(const LbcProblem<Dim>& problem, double objective) {
  return objective / std::pow(problem.scale, Dim - 1);
}

template <int Dim>
void run(Iteration<Dim>& iteration, RunState& state, const RunContext<Dim>& context,
         SolveReport& report) {
  const double tolerance = *context.settings.tolerance;
  const int interval = iteration.interval();
  const int before = state.made;
  const int limit =
      before + std::min(context.settings.max_iterations, std::numeric_limits<int>::max() - before);
  report.status = SolveStatus::kIterationLimit;
  report.criterion = Criterion::kNone;
  while (state.made < limit && (state.made == before || !context.reporter.is_late())) {
    context.reporter.poll();
    const int count = std::min(interval - state.made % interval, limit - state.made);
    const auto step = iteration.iterate(state.made, count);
    state.made += count;
    report.iterations = state.made - before;
    const bool evaluates = state.made % interval == 0;
    const auto [primal, dual] = state.stop.judge(step, tolerance, evaluates);
    require_finite(std::isfinite(primal) && std::isfinite(dual), report);
    report.relative_primal_residual = primal;
    report.relative_dual_residual = dual;
    const bool ends = evaluates && is_finished(iteration, state, context, report);
    const bool converged = ends && report.status == SolveStatus::kConverged;
    const bool moves_on = iteration.adapt({state.made, tolerance * primal, tolerance, converged});
    if (moves_on) {
      state.stop.restart();
      state.begun = state.made;
    }
    if (ends && !(converged && moves_on)) return;
    report.status = SolveStatus::kIterationLimit;
    report.criterion = Criterion::kNone;
  }
}

FLBC_INSTANTIATE_FUNCTION(unscaled)
FLBC_INSTANTIATE_FUNCTION(run)

}  // namespace flbc
