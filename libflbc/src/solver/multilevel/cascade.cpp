// SPDX-License-Identifier: BSD-3-Clause
#include "solver/multilevel/cascade.h"

#include <memory>
#include <optional>
#include <vector>

#include "base/stopwatch.h"
#include "solver/iterative_method.h"
#include "solver/multilevel/level_sizes.h"
#include "solver/warm_start/transfer.h"

namespace flbc {
namespace {

// A mesh that was solved, and in which state.
template <int Dim>
struct Level {
  LbcProblem<Dim> problem;
  MeshState<Dim> state;
};

// A mesh worth a level of its own between the one below (0 vertices = none) and the finest.
template <int Dim>
std::optional<DomainMesh<Dim>> make_mesh(const CoarseMesher<Dim>& mesher, const Cage<Dim>& cage,
                                         Index wanted, Index below, Index finest) {
  constexpr double kClearly = 1.7;
  try {
    auto mesh = mesher(cage, wanted);
    if (kClearly * mesh.num_vertices() > finest || mesh.num_vertices() < kClearly * below)
      return {};
    normalize_and_validate(mesh);
    return mesh;
  } catch (const std::exception&) {
    return {};
  }
}

// The levels, and the solution of the finest one solved so far.
template <int Dim>
class Cascade {
 public:
  Cascade(const LbcProblem<Dim>& problem, const CoarseMesher<Dim>& mesher,
          const SolverOptions& options)
      : problem_(problem), mesher_(mesher), options_(options) {}

  //! Solves the coarse levels, coarsest first.
  void climb() {
    const auto sizes = level_sizes<Dim>(problem_.mesh.num_vertices(), problem_.num_control_points(),
                                        options_.method, options_.coarse_levels);
    for (std::size_t k = 0; k < sizes.size() && !stopped_; ++k) {
      solve_level(sizes[k], static_cast<int>(sizes.size() - k));
    }
  }

  Solution solve_finest(StateStorage* storage) {
    Stopwatch watch;
    auto options = options_;
    if (stopped_) options.max_iterations = 1;  // for weights that belong to this mesh
    const auto transfer = transfer_to(problem_);
    SolveReport report;
    const double placing = watch.lap();
    auto result = run_method(problem_, options, report, storage, {transfer.get(), nullptr});
    if (stopped_) report.status = SolveStatus::kStopped;
    report.seconds.solve += placing;
    for (const auto& level : reports_) {
      report.seconds.solve += level.mesh_seconds + level.setup_seconds + level.solve_seconds;
    }
    report.coarse_levels = reports_;
    return finish(problem_, options, std::move(result), std::move(report));
  }

 private:
  void solve_level(Index vertices, int finer_levels) {
    Stopwatch watch;
    auto mesh =
        make_mesh(mesher_, problem_.cage, vertices,
                  below_ ? below_->problem.mesh.num_vertices() : 0, problem_.mesh.num_vertices());
    if (!mesh) return;
    LevelReport level_report;
    level_report.mesh_seconds = watch.lap();
    auto level = std::make_unique<Level<Dim>>();
    level->problem = make_problem(problem_.cage, std::move(*mesh), options_.phi);
    level_report.setup_seconds = watch.lap();

    auto options = options_;
    options.tolerance *= options_.coarse_levels.looseness;
    options.progress = [&](Progress progress) {
      progress.finer_levels = finer_levels;
      stopped_ = options_.progress && !options_.progress(progress);
      return !stopped_;
    };
    SolveReport report;
    run_method(level->problem, options, report, nullptr,
               {transfer_to(level->problem).get(), &level->state});
    level_report.vertices = report.vertices;
    level_report.cells = report.cells;
    level_report.iterations = report.iterations;
    level_report.solve_seconds = watch.lap();
    reports_.push_back(level_report);
    below_ = std::move(level);
  }

  std::unique_ptr<Transfer<Dim>> transfer_to(const LbcProblem<Dim>& problem) const {
    if (!below_) return nullptr;
    return std::make_unique<Transfer<Dim>>(below_->problem, below_->state, problem);
  }

  const LbcProblem<Dim>& problem_;
  const CoarseMesher<Dim>& mesher_;
  const SolverOptions& options_;
  std::unique_ptr<Level<Dim>> below_;  // the finest solved so far
  std::vector<LevelReport> reports_;
  bool stopped_ = false;
};

}  // namespace

template <int Dim>
Solution solve_in_cascade(const LbcProblem<Dim>& problem, const CoarseMesher<Dim>& mesher,
                          const SolverOptions& options, StateStorage* storage) {
  Cascade<Dim> cascade(problem, mesher, options);
  cascade.climb();
  return cascade.solve_finest(storage);
}

#define FLBC_INSTANTIATE(Dim)                                                          \
  template Solution solve_in_cascade(const LbcProblem<Dim>&, const CoarseMesher<Dim>&, \
                                     const SolverOptions&, StateStorage*);
FLBC_INSTANTIATE(2)
FLBC_INSTANTIATE(3)
#undef FLBC_INSTANTIATE

}  // namespace flbc
