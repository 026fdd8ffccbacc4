// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/solver.h"

#include <utility>

#include "base/parallel.h"
#include "base/stopwatch.h"
#include "flbc/domain_mesh.h"
#include "flbc/errors.h"
#include "problem/problem_geometry.h"
#include "solver/iterative_method.h"
#include "solver/last_run.h"
#include "solver/multilevel/cascade.h"
#include "solver/multilevel/set_up.h"
#include "solver/run_state.h"
#include "solver/solve_parts.h"
#include "solver/state_storage.h"

namespace flbc {
namespace {

// Whether the state that one run leaves is a start for the other.
bool share_state(const SolverOptions& a, const SolverOptions& b) {
  return a.method == b.method && a.precision == b.precision && a.non_negative == b.non_negative &&
         a.linear_solver == b.linear_solver && a.penalty == b.penalty &&
         a.active_pairs == b.active_pairs;
}

//! \param options  resolved
template <int Dim>
std::vector<CoarseProblem<Dim>> coarse_starts(const LbcProblem<Dim>& problem,
                                              const CoarseMesher<Dim>& mesher,
                                              const SolverOptions& options) {
  const auto sizes =
      start_sizes(problem.num_control_points(), problem.mesh.num_vertices(), mesher, options);
  return make_coarse_problems(problem, mesher, sizes, options, CoarseUse{});
}

//! \param options  valid
template <int Dim>
Solution solve_valid(const LbcProblem<Dim>& problem, const SolverOptions& user_options,
                     const CoarseMesher<Dim>& mesher, StateStorage* storage) {
  const auto options = offering_nothing(resolve(user_options));
  const ThreadScope threads(
      threads_for(options.threads, problem.num_control_points(), problem.mesh.num_vertices()));
  std::vector<CoarseProblem<Dim>> coarse;
  if (!resumes(storage)) coarse = coarse_starts(problem, mesher, options);
  return finish<Solution>(problem, options,
                          solve_in_cascade(problem, std::move(coarse), options, storage));
}

// A problem set up for a method that does not minimise comes without.
template <int Dim>
void require_phi(const LbcProblem<Dim>& problem, const SolverOptions& options) {
  if (!minimises(options.method) || problem.phi.cols() == problem.mesh.num_cells()) return;
  throw InputError(
      "the problem has no weight functions phi for the cells of its mesh; make_problem() "
      "computes them");
}

void add_set_up(double seconds, const DistanceReport& distances, SolveReport& report) {
  report.seconds.setup = seconds;
  report.distances = distances;
}

// From the state that the options bring.
template <class Result, int Dim>
Result go_on(const Cage<Dim>& cage, const DomainMesh<Dim>& mesh, SolverOptions options) {
  Stopwatch watch;
  auto told = options;
  auto record = take_record(told, cage, mesh);
  auto problem = make_geometry(cage, mesh);
  problem.phi = {options.phi, std::move(record.distances), problem.mesh,
                 problem.num_control_points()};
  const double setup_seconds = record.setup_seconds + watch.lap();
  // In the order in which they are read.
  options.resume_from = told.resume_from;
  told = offering_levels(offering_record(options, cage, mesh, problem.phi.distances(),
                                         record.source, setup_seconds, record.solve_seconds),
                         record.levels);
  MethodRun run;
  run.result = run_method(problem, told, run.report, nullptr, WarmStart<Dim>{});
  run.report.coarse_levels = std::move(record.levels);
  run.report.seconds.solve += record.solve_seconds;
  auto solution = finish<Result>(problem, options, std::move(run));
  add_set_up(setup_seconds, record.source, solution.report);
  return solution;
}

// solve() of a cage and a mesh, in the form that is wanted. \param topology  null if not known
template <class Result, int Dim>
Result solve_cage(const Cage<Dim>& cage, const DomainMesh<Dim>& mesh, const SolverOptions& options,
                  const CoarseMesher<Dim>& mesher, const MeshTopology<Dim>* topology = nullptr) {
  require_valid_set_up(options, bool(mesher));
  if (count_parts(mesh) > 1) return solve_parts<Result, Dim>(cage, mesh, options, mesher);
  const ThreadScope threads(threads_for(options.threads, cage.size(), mesh.num_vertices()));
  const auto resolved = resolve(options);
  if (!resolved.resume_from.empty()) return go_on<Result>(cage, mesh, resolved);
  auto ready = set_up<Dim>(cage, mesh, resolved, mesher, nullptr, topology);
  double coarse_seconds = 0;
  for (const auto& level : ready.coarse) {
    coarse_seconds += level.report.mesh_seconds + level.report.setup_seconds;
  }
  const auto told = offering_record(resolved, cage, mesh, ready.problem.phi.distances(),
                                    ready.distances, ready.seconds, coarse_seconds);
  auto solution = finish<Result>(
      ready.problem, told, solve_in_cascade(ready.problem, std::move(ready.coarse), told));
  add_set_up(ready.seconds, ready.distances, solution.report);
  return solution;
}

}  // namespace

template <int Dim>
Solution solve(const LbcProblem<Dim>& problem, const SolverOptions& options,
               const MesherArgument<Dim>& mesher, StateStorage* storage) {
  require_valid(options, bool(mesher));
  refuse_state(options);
  require_phi(problem, resolve(options));
  return solve_valid(problem, options, mesher, storage);
}

template <int Dim>
Solution solve(const Cage<Dim>& cage, const DomainMesh<Dim>& mesh, const SolverOptions& options,
               const MesherArgument<Dim>& mesher) {
  return solve_cage<Solution, Dim>(cage, mesh, options, mesher);
}

template <int Dim>
Solution solve(const Cage<Dim>& cage, const DomainMesh<Dim>& mesh,
               const MeshTopology<Dim>& topology, const SolverOptions& options,
               const MesherArgument<Dim>& mesher) {
  return solve_cage<Solution, Dim>(cage, mesh, options, mesher, &topology);
}

template <int Dim>
SparseSolution solve_sparse(const Cage<Dim>& cage, const DomainMesh<Dim>& mesh,
                            const SolverOptions& options, const MesherArgument<Dim>& mesher) {
  return solve_cage<SparseSolution, Dim>(cage, mesh, options, mesher);
}

template <int Dim>
class LbcSolver<Dim>::State {
 public:
  State(const Cage<Dim>& cage, const DomainMesh<Dim>& mesh, const SolverOptions& options,
        const CoarseMesher<Dim>& mesher)
      : options_(options), mesher_(mesher) {
    refuse_state(options);
    const ThreadScope threads(threads_for(options.threads, cage.size(), mesh.num_vertices()));
    ready_ = set_up(cage, mesh, resolve(options), mesher);
  }

  void solve() {
    try {
      complete();
      solution_ = solve_next();
    } catch (...) {
      restart();
      throw;
    }
    add_set_up(std::exchange(ready_.seconds, 0), ready_.distances, solution_.report);
  }

  void set_options(const SolverOptions& options) {
    require_valid(options, bool(mesher_));
    refuse_state(options);
    if (options.phi != options_.phi) {
      throw OptionError("phi cannot be changed once the problem is set up; make another LbcSolver");
    }
    if (!share_state(resolve(options), resolve(options_))) restart();
    ready_.coarse.clear();  // made for the options before
    options_ = options;
  }

  void restart() {
    last_run_.forget();
    ready_.coarse.clear();
  }

  const SolverOptions& options() const { return options_; }
  const LbcProblem<Dim>& problem() const { return ready_.problem; }
  const Solution& solution() const { return solution_; }

 private:
  // Phi, once a method needs it.
  void complete() {
    auto& problem = ready_.problem;
    if (problem.phi.size() > 0 || !minimises(resolve(options_).method)) return;
    const ThreadScope threads(
        threads_for(options_.threads, problem.num_control_points(), problem.mesh.num_vertices()));
    Stopwatch watch;
    problem.phi = {options_.phi, distances_for(options_.phi, problem), problem.mesh,
                   problem.num_control_points()};
    ready_.seconds += watch.lap();
  }

  // What set_up() made for the first solve serves that one alone.
  Solution solve_next() {
    const auto& problem = ready_.problem;
    const auto options = offering_nothing(resolve(options_));
    const ThreadScope threads(
        threads_for(options.threads, problem.num_control_points(), problem.mesh.num_vertices()));
    auto coarse = std::exchange(ready_.coarse, {});
    if (coarse.empty() && !last_run_.is_there()) coarse = coarse_starts(problem, mesher_, options);
    return finish<Solution>(problem, options, last_run_.go_on(problem, std::move(coarse), options));
  }

  SolverOptions options_;
  CoarseMesher<Dim> mesher_;
  SetUp<Dim> ready_;  // seconds until a report has told them, coarse problems until they are used
  LastRun<Dim> last_run_;
  Solution solution_{};
};

template <int Dim>
LbcSolver<Dim>::LbcSolver(const Cage<Dim>& cage, const DomainMesh<Dim>& mesh,
                          const SolverOptions& options, const CoarseMesher<Dim>& mesher) {
  require_valid_set_up(options, bool(mesher));
  state_ = std::make_unique<State>(cage, mesh, options, mesher);
}

template <int Dim>
LbcSolver<Dim>::~LbcSolver() = default;
template <int Dim>
LbcSolver<Dim>::LbcSolver(LbcSolver&&) noexcept = default;
template <int Dim>
LbcSolver<Dim>& LbcSolver<Dim>::operator=(LbcSolver&&) noexcept = default;

template <int Dim>
const Solution& LbcSolver<Dim>::solve() {
  state_->solve();
  return solution();
}

template <int Dim>
void LbcSolver<Dim>::set_options(const SolverOptions& options) {
  state_->set_options(options);
}

template <int Dim>
void LbcSolver<Dim>::restart() {
  state_->restart();
}

template <int Dim>
const SolverOptions& LbcSolver<Dim>::options() const {
  return state_->options();
}

template <int Dim>
const LbcProblem<Dim>& LbcSolver<Dim>::problem() const {
  return state_->problem();
}

template <int Dim>
const Solution& LbcSolver<Dim>::solution() const {
  return state_->solution();
}

#define FLBC_INSTANTIATE(Dim)                                                                  \
  template Solution solve(const LbcProblem<Dim>&, const SolverOptions&,                        \
                          const MesherArgument<Dim>&, StateStorage*);                          \
  template Solution solve<Dim>(const Cage<Dim>&, const DomainMesh<Dim>&, const SolverOptions&, \
                               const MesherArgument<Dim>&);                                    \
  template Solution solve<Dim>(const Cage<Dim>&, const DomainMesh<Dim>&,                       \
                               const MeshTopology<Dim>&, const SolverOptions&,                 \
                               const MesherArgument<Dim>&);                                    \
  template SparseSolution solve_sparse<Dim>(const Cage<Dim>&, const DomainMesh<Dim>&,          \
                                            const SolverOptions&, const MesherArgument<Dim>&); \
  template class LbcSolver<Dim>;
FLBC_INSTANTIATE(2)
FLBC_INSTANTIATE(3)
#undef FLBC_INSTANTIATE

}  // namespace flbc
