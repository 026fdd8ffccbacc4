// SPDX-License-Identifier: BSD-3-Clause
#include "solver/run/run.h"

#include <algorithm>
#include <cmath>
#include <string>

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
  Progress progress{report.iterations, report.primal_residual, report.dual_residual};
  progress.objective = [&] {
    const auto weights = iteration.weights();
    return unscaled(problem, weights.is_sparse() ? objective(problem, weights.sparse)
                                                 : objective(problem, weights.dense));
  };
  return progress;
}

// Iterates with as many threads as the machine has cores to spare.
template <int Dim>
Step iterate(Iteration<Dim>& iteration, int count, bool measure, ThreadChoice& choice) {
  const ThreadScope scope(choice.threads());
  const double on_core = seconds_on_core();
  Stopwatch watch;
  const Step step = iteration.iterate(count, measure);
  choice.note(count, watch.lap(), seconds_on_core() - on_core);
  return step;
}

// Ends the run or reports progress. Sets status and criterion. \return whether to stop
template <int Dim>
bool is_finished(const Iteration<Dim>& iteration, const RunContext<Dim>& context,
                 SolveReport& report) {
  const bool last = report.iterations >= context.options.max_iterations;
  report.status = SolveStatus::kConverged;
  report.criterion = Criterion::kTolerance;
  if (report.primal_residual <= 1 && report.dual_residual <= 1) return true;
  report.criterion = Criterion::kGap;
  if (context.gap.is_met(iteration, report.iterations, last, report.primal_residual)) return true;
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
bool run(Iteration<Dim>& iteration, const RunContext<Dim>& context, SolveReport& report,
         int pause) {
  auto& stop = context.stop;
  const auto adapt = [&](bool ends) {
    const double error = *context.options.tolerance * std::max(report.primal_residual, 1.0);
    const int to_make = iteration.adapt(report.iterations, error, ends);
    if (to_make > 0) stop.not_before(report.iterations + to_make);
    return to_make > 0;
  };
  ThreadChoice choice(omp_get_max_threads());
  stop.begin(iteration);
  if (report.iterations > 0) adapt(false);
  while (report.iterations < pause) {
    context.reporter.poll();
    const int count = stop.next(report.iterations);
    const Step step = iterate(iteration, count, stop.wants_residuals(), choice);
    report.iterations += count;
    if (stop.judge(step, iteration, report)) {
      require_finite(std::isfinite(report.primal_residual) && std::isfinite(report.dual_residual),
                     report);
      if (is_finished(iteration, context, report)) {
        if (report.status != SolveStatus::kConverged || !adapt(true)) return true;
        continue;
      }
    }
    if (report.iterations < pause) adapt(false);
  }
  report.status = SolveStatus::kIterationLimit;
  return false;
}

FLBC_INSTANTIATE_FUNCTION(unscaled)
FLBC_INSTANTIATE_FUNCTION(run)

}  // namespace flbc
