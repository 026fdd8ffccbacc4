// SPDX-License-Identifier: BSD-3-Clause
#include "solver/multilevel/cascade.h"

#include <memory>
#include <utility>

#include "base/stopwatch.h"
#include "solver/methods/active_set/active_lists.h"
#include "solver/plan/choices.h"
#include "solver/start/transfer.h"

namespace flbc {
namespace {

// The levels, and the duals of the finest one solved so far.
template <int Dim>
class Cascade {
 public:
  Cascade(const LbcProblem<Dim>& problem, std::vector<CoarseProblem<Dim>> levels,
          const SolverOptions& options, const Reporter& reporter)
      : problem_(problem), levels_(std::move(levels)), options_(options), reporter_(reporter) {}

  //! Solves the coarse levels, coarsest first.
  void climb() {
    while (num_solved_ < levels_.size() && !stopped_) solve_level(levels_[num_solved_]);
  }

  Weights solve_finest(MethodRun<Dim>& run, SolveReport& report) {
    Stopwatch watch;
    auto options = options_;
    if (stopped_) options.max_iterations = 1;  // for weights that belong to this mesh
    std::unique_ptr<Transfer<Dim>> transfer;
    if (num_solved_ > 0) {
      auto& below = levels_[num_solved_ - 1];
      transfer = std::make_unique<Transfer<Dim>>(below.problem, duals_, problem_,
                                                 std::move(below.finest_vertices));
    }
    const double placing = watch.lap();
    const auto forget_levels = [&] {
      transfer.reset();
      duals_ = {};
      for (auto& level : levels_) level = {{}, {}, level.report};
    };
    auto weights = run.solve(options, reporter_, report, {transfer.get(), nullptr, forget_levels});
    if (stopped_) report.status = SolveStatus::kStopped;
    report.seconds.solve += placing;
    for (std::size_t k = 0; k < levels_.size(); ++k) {
      const auto& level = levels_[k].report;
      report.seconds.solve += level.mesh_seconds + level.setup_seconds + level.solve_seconds;
      if (k < num_solved_) report.coarse_levels.push_back(level);
    }
    return weights;
  }

 private:
  void solve_level(CoarseProblem<Dim>& level) {
    Stopwatch watch;
    auto options = options_;
    *options.tolerance *= options_.coarse_levels.looseness;
    const auto finer_levels = static_cast<int>(levels_.size() - num_solved_);
    std::unique_ptr<Transfer<Dim>> transfer;
    if (num_solved_ > 0) {
      transfer =
          std::make_unique<Transfer<Dim>>(levels_[num_solved_ - 1].problem, duals_, level.problem);
    }
    SolveReport report;
    MethodRun<Dim> run(level.problem);
    const auto started = [&level] { level.cold.reset(); };
    run.solve(options, reporter_.with_more_to_come(finer_levels), report,
              {transfer.get(), level.cold ? &*level.cold : nullptr, started, true});
    stopped_ = report.status == SolveStatus::kStopped;
    duals_ = run.duals(handed_on(level.problem));
    level.problem.phi = {};  // finer ones have theirs
    level.report.iterations = report.iterations;
    level.report.solve_seconds = watch.lap();
    ++num_solved_;
  }

  // An active set on the finer mesh reads duals only where weights are.
  double handed_on(const LbcProblem<Dim>& problem) const {
    return plan::active_set(plan::sizes_of(problem), options_)
               ? active_set::threshold_for(*options_.tolerance)
               : 0;
  }

  const LbcProblem<Dim>& problem_;
  std::vector<CoarseProblem<Dim>> levels_;
  const SolverOptions& options_;
  const Reporter& reporter_;
  Duals<Dim> duals_;  // of the finest level solved so far
  std::size_t num_solved_ = 0;
  bool stopped_ = false;
};

}  // namespace

template <int Dim>
Weights solve_in_cascade(const LbcProblem<Dim>& problem, MethodRun<Dim>& run,
                         std::vector<CoarseProblem<Dim>> levels, const SolverOptions& options,
                         const Reporter& reporter, SolveReport& report) {
  Cascade<Dim> cascade(problem, std::move(levels), options, reporter);
  cascade.climb();
  return cascade.solve_finest(run, report);
}

#define FLBC_INSTANTIATE(Dim)                                                              \
  template Weights solve_in_cascade(const LbcProblem<Dim>&, MethodRun<Dim>&,               \
                                    std::vector<CoarseProblem<Dim>>, const SolverOptions&, \
                                    const Reporter&, SolveReport&);
FLBC_INSTANTIATE(2)
FLBC_INSTANTIATE(3)
#undef FLBC_INSTANTIATE

}  // namespace flbc
