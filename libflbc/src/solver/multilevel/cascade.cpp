// SPDX-License-Identifier: BSD-3-Clause
#include "solver/multilevel/cascade.h"

#include <memory>
#include <utility>
#include <vector>

#include "base/stopwatch.h"
#include "solver/iterative_method.h"
#include "solver/run_state.h"
#include "solver/warm_start/transfer.h"

namespace flbc {
namespace {

// The levels, and the solution of the finest one solved so far.
template <int Dim>
class Cascade {
 public:
  Cascade(const LbcProblem<Dim>& problem, std::vector<CoarseProblem<Dim>> levels,
          const SolverOptions& options)
      : problem_(problem), levels_(std::move(levels)), options_(options) {}

  //! Solves the coarse levels, coarsest first.
  void climb() {
    while (num_solved_ < levels_.size() && !stopped_) solve_level(levels_[num_solved_]);
  }

  MethodRun solve_finest(StateStorage* storage, MeshState<Dim>* final_state) {
    Stopwatch watch;
    std::vector<LevelReport> reports;
    for (std::size_t k = 0; k < num_solved_; ++k) reports.push_back(levels_[k].report);
    auto options = offering_levels(options_, reports);
    if (stopped_) options.max_iterations = 1;  // for weights that belong to this mesh
    std::unique_ptr<Transfer<Dim>> transfer;
    if (num_solved_ > 0) {
      auto& below = levels_[num_solved_ - 1];
      transfer = std::make_unique<Transfer<Dim>>(below.problem, state_, problem_,
                                                 std::move(below.finest_vertices));
    }
    SolveReport report;
    const double placing = watch.lap();
    const auto forget_levels = [&] {
      transfer.reset();
      state_ = {};
      for (auto& level : levels_) level = {{}, {}, level.report};
    };
    auto result = run_method(problem_, options, report, storage,
                             {transfer.get(), final_state, forget_levels});
    if (stopped_) report.status = SolveStatus::kStopped;
    report.seconds.solve += placing;
    for (const auto& level : levels_) {
      report.seconds.solve +=
          level.report.mesh_seconds + level.report.setup_seconds + level.report.solve_seconds;
    }
    report.coarse_levels = std::move(reports);
    return {std::move(result), std::move(report)};
  }

 private:
  void solve_level(CoarseProblem<Dim>& level) {
    Stopwatch watch;
    auto options = options_;
    options.tolerance *= options_.coarse_levels.looseness;
    const auto finer_levels = static_cast<int>(levels_.size() - num_solved_);
    options.progress = [&](Progress progress) {
      progress.finer_levels = finer_levels;
      progress.write_state = {};
      stopped_ = options_.progress && !options_.progress(progress);
      return !stopped_;
    };
    std::unique_ptr<Transfer<Dim>> transfer;
    if (num_solved_ > 0) {
      transfer =
          std::make_unique<Transfer<Dim>>(levels_[num_solved_ - 1].problem, state_, level.problem);
    }
    SolveReport report;
    MeshState<Dim> state;
    const auto started = [&level] { level.cold.reset(); };
    run_method(level.problem, options, report, nullptr,
               {transfer.get(), &state, started, level.cold ? &*level.cold : nullptr, true});
    state_ = std::move(state);
    level.problem.phi = {};  // finer ones have theirs
    level.report.iterations = report.iterations;
    level.report.solve_seconds = watch.lap();
    ++num_solved_;
  }

  const LbcProblem<Dim>& problem_;
  std::vector<CoarseProblem<Dim>> levels_;
  const SolverOptions& options_;
  MeshState<Dim> state_;  // of the finest level solved so far
  std::size_t num_solved_ = 0;
  bool stopped_ = false;
};

}  // namespace

template <int Dim>
MethodRun solve_in_cascade(const LbcProblem<Dim>& problem, std::vector<CoarseProblem<Dim>> levels,
                           const SolverOptions& options, StateStorage* storage,
                           MeshState<Dim>* final_state) {
  Cascade<Dim> cascade(problem, std::move(levels), options);
  cascade.climb();
  return cascade.solve_finest(storage, final_state);
}

#define FLBC_INSTANTIATE(Dim)                                                                  \
  template MethodRun solve_in_cascade(const LbcProblem<Dim>&, std::vector<CoarseProblem<Dim>>, \
                                      const SolverOptions&, StateStorage*, MeshState<Dim>*);
FLBC_INSTANTIATE(2)
FLBC_INSTANTIATE(3)
#undef FLBC_INSTANTIATE

}  // namespace flbc
