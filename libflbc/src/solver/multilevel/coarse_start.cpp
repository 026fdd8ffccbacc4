// SPDX-License-Identifier: BSD-3-Clause
#include "solver/multilevel/coarse_start.h"

#include <algorithm>
#include <utility>

#include "base/instantiate.h"
#include "base/parallel.h"
#include "base/stopwatch.h"
#include "solver/methods/active_set/active_lists.h"
#include "solver/plan/choices.h"
#include "solver/plan/constants.h"
#include "solver/start/prolongation.h"

namespace flbc {
namespace {

// \return whether it was stopped
template <int Dim>
bool solve_coarse(const LbcProblem<Dim>& problem, const plan::Settings& given,
                  const Reporter& reporter, WarmStart<Dim>& warm_start, LevelReport& level) {
  Stopwatch watch;
  auto settings = given;
  settings.tolerance = plan::kCoarseTolerance;
  settings.certify = false;
  const ThreadScope threads(
      threads_for(given.threads, problem.num_control_points(), problem.mesh.num_vertices()));
  settings.gap = 0;
  settings.ends_by_gap = false;
  SolveReport report;
  MethodRun<Dim> run(problem);
  run.solve(settings, reporter.with_more_to_come(1), report);
  // An active set on the finer mesh reads duals only near nonzero weights.
  const bool on_active_set = plan::active_set(plan::sizes_of(problem), given);
  warm_start = run.warm_start(on_active_set ? active_set::threshold_for(*given.tolerance) : 0);
  level = {report.vertices, report.cells, report.iterations, watch.lap()};
  return report.status == SolveStatus::kStopped;
}

// SolveReport::mesh_error. \param coarse  weights on the coarse mesh
template <int Dim>
double mesh_error(const LbcProblem<Dim>& problem, const Weights& weights,
                  const SparseWeights& coarse, const std::vector<std::array<Index, 2>>& ends) {
  const auto& interior = problem.boundary.interior_vertices();
  const auto count = static_cast<Index>(interior.size());
  const double sum = parallel_sum(count, 0.0, [&](Index begin, Index end) {
    double part = 0;
    for (Index k = begin; k < end; ++k) {
      const Index v = interior[k];
      const auto [a, b] = ends[v];
      const Eigen::VectorXd here =
          weights.is_sparse() ? weights.sparse.at(v) : weights.dense.col(v);
      part += (here - (coarse.at(a) + coarse.at(b)) / 2).squaredNorm();
    }
    return part;
  });
  const double numbers = std::max(1.0, double(count) * problem.num_control_points());
  return sum / numbers / plan::coarse_to_mesh_error(Dim);
}

}  // namespace

template <int Dim>
Weights solve_within(const Budget& budget, double spent, MethodRun<Dim>& run,
                     const plan::Settings& given, const Reporter& reporter, SolveReport& report,
                     const RunStart<Dim>& start) {
  auto settings = given;
  if (budget.iterations > 0) {
    settings.max_iterations = std::min(settings.max_iterations, budget.iterations);
  }
  return run.solve(settings,
                   budget.seconds > 0 ? reporter.with_limit(budget.seconds - spent) : reporter,
                   report, start);
}

template <int Dim>
Weights solve_from_coarse(const LbcProblem<Dim>& problem, MethodRun<Dim>& run,
                          std::optional<CoarseProblem<Dim>> coarse, const Prolongation<Dim>* before,
                          const plan::Settings& given, const Budget& budget,
                          const Reporter& reporter, SolveReport& report) {
  if (!coarse) return solve_within<Dim>(budget, 0, run, given, reporter, report, {before});
  Stopwatch watch;
  WarmStart<Dim> warm_start;
  LevelReport level;
  const bool stopped = solve_coarse(coarse->problem, given, reporter, warm_start, level);
  auto settings = given;
  if (stopped) settings.max_iterations = 1;  // one iteration, to get weights on this mesh
  const double spent = watch.seconds();
  const auto ends = std::move(coarse->ends);
  const Prolongation<Dim> prolongation(coarse->problem, warm_start, problem, ends);
  SparseWeights coarse_weights;
  const auto forget = [&] {
    coarse_weights = std::move(warm_start.weights);
    warm_start = {};
    coarse.reset();
  };
  const RunStart<Dim> start = before != nullptr ? RunStart<Dim>{before, &prolongation, forget}
                                                : RunStart<Dim>{&prolongation, nullptr, forget};
  auto weights = solve_within<Dim>(budget, spent, run, settings, reporter, report, start);
  if (stopped) report.status = SolveStatus::kStopped;
  report.seconds.solve += spent;
  report.coarse_levels = {level};
  report.mesh_error = mesh_error(problem, weights, coarse_weights, ends);
  return weights;
}

FLBC_INSTANTIATE_FUNCTION(solve_within)
FLBC_INSTANTIATE_FUNCTION(solve_from_coarse)

}  // namespace flbc
