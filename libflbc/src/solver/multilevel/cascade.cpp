// SPDX-License-Identifier: BSD-3-Clause
#include "solver/multilevel/cascade.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "base/instantiate.h"
#include "base/stopwatch.h"
#include "solver/methods/active_set/active_lists.h"
#include "solver/plan/choices.h"
#include "solver/plan/constants.h"
#include "solver/start/transfer.h"

namespace flbc {
namespace {

// \param below  next coarser level; null: none \param finer_levels  yet to be solved
// \param duals  in: of the level below; out: of this level \return whether it was stopped
template <int Dim>
bool solve_level(CoarseProblem<Dim>& level, const CoarseProblem<Dim>* below, int finer_levels,
                 const plan::Settings& given, const Reporter& reporter, Duals<Dim>& duals) {
  Stopwatch watch;
  auto settings = given;
  *settings.tolerance *= plan::kLooseness;
  settings.gap = 0;
  settings.ends_by_gap = false;
  std::optional<Transfer<Dim>> transfer;
  if (below != nullptr) transfer.emplace(below->problem, duals, level.problem);
  SolveReport report;
  MethodRun<Dim> run(level.problem);
  run.solve(settings, reporter.with_more_to_come(finer_levels), report,
            {transfer ? &*transfer : nullptr});
  // An active set on the finer mesh reads duals only near nonzero weights.
  const bool on_active_set = plan::active_set(plan::sizes_of(level.problem), given);
  duals = run.duals(on_active_set ? active_set::threshold_for(*given.tolerance) : 0);
  level.problem.phi = {};  // finer levels have their own
  level.report.iterations = report.iterations;
  level.report.solve_seconds = watch.lap();
  return report.status == SolveStatus::kStopped;
}

}  // namespace

template <int Dim>
Weights solve_within(const Budget& budget, double spent, MethodRun<Dim>& run,
                     const plan::Settings& given, const Reporter& reporter, SolveReport& report,
                     const WarmStart<Dim>& start) {
  auto settings = given;
  if (budget.iterations > 0) {
    settings.max_iterations = std::min(settings.max_iterations, budget.iterations);
  }
  return run.solve(settings,
                   budget.seconds > 0 ? reporter.with_limit(budget.seconds - spent) : reporter,
                   report, start);
}

template <int Dim>
Weights solve_in_cascade(const LbcProblem<Dim>& problem, MethodRun<Dim>& run,
                         std::vector<CoarseProblem<Dim>> levels, const plan::Settings& given,
                         const Budget& budget, const Reporter& reporter, SolveReport& report) {
  Stopwatch watch;
  Duals<Dim> duals;
  std::size_t num_solved = 0;
  CoarseProblem<Dim>* below = nullptr;
  bool stopped = false;
  while (num_solved < levels.size() && !stopped) {
    auto& level = levels[num_solved];
    const auto finer_levels = static_cast<int>(levels.size() - num_solved++);
    stopped = solve_level(level, below, finer_levels, given, reporter, duals);
    below = &level;
  }
  auto settings = given;
  if (stopped) settings.max_iterations = 1;  // one iteration, to get weights on this mesh
  std::optional<Transfer<Dim>> transfer;
  if (below != nullptr) {
    transfer.emplace(below->problem, duals, problem, std::move(below->finest_vertices));
  }
  const double spent = watch.seconds();
  const auto forget_levels = [&] {
    transfer.reset();
    duals = {};
    for (auto& level : levels) level = {{}, {}, level.report};
  };
  auto weights = solve_within<Dim>(budget, spent, run, settings, reporter, report,
                                   {transfer ? &*transfer : nullptr, forget_levels});
  if (stopped) report.status = SolveStatus::kStopped;
  report.seconds.solve += spent;
  for (std::size_t k = 0; k < levels.size(); ++k) {
    const auto& level = levels[k].report;
    report.seconds.solve += level.mesh_seconds + level.setup_seconds;
    if (k < num_solved) report.coarse_levels.push_back(level);
  }
  return weights;
}

FLBC_INSTANTIATE_FUNCTION(solve_within)
FLBC_INSTANTIATE_FUNCTION(solve_in_cascade)

}  // namespace flbc
