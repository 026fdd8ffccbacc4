// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/solver.h"

#include <utility>

#include "base/parallel.h"
#include "base/stopwatch.h"
#include "flbc/errors.h"
#include "solver/iterative_method.h"
#include "solver/multilevel/cascade.h"
#include "solver/state_storage.h"

namespace flbc {
namespace {

void require_valid(const SolverOptions& options, bool has_mesher) {
  validate(options);
  if (options.coarse_to_fine == CoarseToFine::kOn && !has_mesher) {
    throw OptionError("coarse_to_fine cannot be on without a mesher for the coarser meshes");
  }
}

// Whether the state that one run leaves is a start for the other.
bool share_state(const SolverOptions& a, const SolverOptions& b) {
  return a.method == b.method && a.precision == b.precision && a.non_negative == b.non_negative &&
         a.linear_solver == b.linear_solver && a.penalty == b.penalty;
}

//! \param options  valid
template <int Dim>
Solution solve_valid(const LbcProblem<Dim>& problem, const SolverOptions& user_options,
                     const CoarseMesher<Dim>& mesher, StateStorage* storage) {
  const auto options = resolve(user_options);
  const ThreadScope threads(options.threads);
  const bool resumes = storage != nullptr && storage->penalty() > 0;
  if (mesher && options.coarse_to_fine != CoarseToFine::kOff && inherits(options.method) &&
      !resumes) {
    return solve_in_cascade(problem, mesher, options, storage);
  }
  SolveReport report;
  auto result = run_method(problem, options, report, storage, WarmStart<Dim>{});
  return finish(problem, options, std::move(result), std::move(report));
}

}  // namespace

template <int Dim>
Solution solve(const LbcProblem<Dim>& problem, const SolverOptions& options,
               const MesherArgument<Dim>& mesher, StateStorage* storage) {
  require_valid(options, bool(mesher));
  return solve_valid(problem, options, mesher, storage);
}

template <int Dim>
Solution solve(const Cage<Dim>& cage, const DomainMesh<Dim>& mesh, const SolverOptions& options,
               const MesherArgument<Dim>& mesher) {
  require_valid(options, bool(mesher));
  const ThreadScope threads(options.threads);
  Stopwatch watch;
  const auto problem = make_problem(cage, mesh, options.phi);
  const double setup = watch.lap();
  auto solution = solve_valid(problem, options, mesher, nullptr);
  solution.report.seconds.setup = setup;
  return solution;
}

template <int Dim>
class LbcSolver<Dim>::State {
 public:
  State(const Cage<Dim>& cage, const DomainMesh<Dim>& mesh, const SolverOptions& options,
        const CoarseMesher<Dim>& mesher)
      : options_(options), mesher_(mesher) {
    const ThreadScope threads(options.threads);
    Stopwatch watch;
    problem_ = make_problem(cage, mesh, options.phi);
    setup_seconds_ = watch.lap();
  }

  void solve() {
    try {
      solution_ = solve_valid(problem_, options_, mesher_, &kept_);
    } catch (...) {
      restart();
      throw;
    }
    solution_.report.seconds.setup = std::exchange(setup_seconds_, 0);
  }

  void set_options(const SolverOptions& options) {
    require_valid(options, bool(mesher_));
    if (options.phi != options_.phi) {
      throw OptionError("phi cannot be changed once the problem is set up; make another LbcSolver");
    }
    if (!share_state(resolve(options), resolve(options_))) restart();
    options_ = options;
  }

  void restart() { kept_.forget(); }

  const SolverOptions& options() const { return options_; }
  const LbcProblem<Dim>& problem() const { return problem_; }
  const Solution& solution() const { return solution_; }

 private:
  SolverOptions options_;
  CoarseMesher<Dim> mesher_;
  LbcProblem<Dim> problem_;
  double setup_seconds_ = 0;  // until a report has told them
  KeptState kept_;
  Solution solution_{};
};

template <int Dim>
LbcSolver<Dim>::LbcSolver(const Cage<Dim>& cage, const DomainMesh<Dim>& mesh,
                          const SolverOptions& options, const CoarseMesher<Dim>& mesher) {
  require_valid(options, bool(mesher));
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
  template class LbcSolver<Dim>;
FLBC_INSTANTIATE(2)
FLBC_INSTANTIATE(3)
#undef FLBC_INSTANTIATE

}  // namespace flbc
