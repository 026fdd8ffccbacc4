// SPDX-License-Identifier: BSD-3-Clause
// Method::kValue from start to weights.
#include <algorithm>
#include <functional>
#include <memory>
#include <optional>
#include <type_traits>
#include <utility>

#include "base/stopwatch.h"
#include "flbc/bounding_box.h"
#include "flbc/certificate.h"
#include "solver/iterative_method.h"
#include "solver/run_state.h"
#include "solver/splitting/compact_splitting.h"
#include "solver/splitting/error_estimate.h"
#include "solver/state_storage.h"

namespace flbc {
namespace {

template <class Scalar, class Stored, int Dim>
using ValueSplitting = compact::CompactSplitting<Scalar, Stored, Dim>;

// The penalty grows to no more than this: what is balanced are lengths of all that moves, and where
// the start is nearly right everywhere, as on round cages, that takes the penalty out of the range
// in which the rest converges.
template <int Dim>
double largest_penalty(const LbcProblem<Dim>& problem) {
  return bounding_box_diagonal(problem.cage.points) / 30;
}

// A run from its start to its end, which may go on in another precision on the way.
template <class Scalar, int Dim>
class Run {
 public:
  //! \param measure  of the domain \param adaptive  whether the penalty is to be balanced
  Run(const LbcProblem<Dim>& problem, double measure, const SolverOptions& options, bool adaptive,
      bool warm, SolveReport& report)
      : problem_(problem),
        options_(options),
        adaptive_(adaptive),
        warm_(warm),
        report_(report),
        num_weights_(
            std::max(1.0, static_cast<double>(problem.boundary.interior_vertices().size())) *
            problem.num_control_points()),
        residual_scale_(square(bounding_box_diagonal(problem.cage.points)) /
                        (problem.num_control_points() * measure)),
        estimate_(warm, options.tolerance),
        gap_(*options.gap, [this] { return certificate_(); }) {}

  //! Goes on from what visit() has written.
  template <class Stored>
  void resume(ByteReader& read, const ValueSplitting<Scalar, Stored, Dim>& splitting) {
    history_.emplace(splitting.history());
    visit(read);
    refuse_rest(read);
  }

  //! \param certify_weights  by the duals of the splitting
  //! \return whether the run has ended; otherwise it is to go on in single precision
  template <class Stored>
  bool iterate(ValueSplitting<Scalar, Stored, Dim>& splitting,
               const std::function<Certificate(const WeightMatrix&)>& certify_weights) {
    constexpr int kFewest = 8;
    constexpr bool kIsHalf = std::is_same_v<Stored, compact::Half>;
    const auto options =
        offering(with_objective(problem_, options_, [&] { return splitting.weights(); }),
                 [&](ByteWriter& write) {
                   write(kIsHalf, splitting.penalty(), warm_);
                   splitting.visit(write);
                   visit(write);
                 });
    certificate_ = [&] { return certify_weights(splitting.weights()); };
    const auto read = [&](Index row, Scalar* weights) { splitting.read_row(row, weights); };
    if (!history_) {
      history_.emplace(splitting.history());
      (*history_)(0, read);
    }
    for (;;) {
      if (kIsHalf && report_.iterations > 0 && trembles(report_.iterations)) return false;
      const int iteration = ++report_.iterations;
      const auto step = step_at(iteration, splitting);
      const double difference = (*history_)(iteration, read) / problem_.num_control_points();
      report_.primal_residual = estimate_(iteration, step.change / num_weights_, difference,
                                          step.violation * residual_scale_) /
                                options_.tolerance;
      const bool look = iteration % options_.check_interval == 0 ||
                        (iteration >= kFewest && report_.primal_residual <= 1) ||
                        iteration == options_.max_iterations;
      if (look && finished(iteration, options, gap_, report_)) return true;
    }
  }

 private:
  static double square(double x) { return x * x; }

  template <class Archive>
  void visit(Archive& archive) {
    archive(report_.iterations, report_.primal_residual);
    history_->visit(archive);
    estimate_.visit(archive);
    gap_.visit(archive);
  }

  template <class Stored>
  compact::Step step_at(int iteration, ValueSplitting<Scalar, Stored, Dim>& splitting) const {
    constexpr double kBalance = 0.3;
    const bool adapts = iteration == 5 || iteration == 10 || iteration == 20 || iteration == 40;
    if (adaptive_ && adapts)
      return splitting.iterate_and_adapt(kBalance, largest_penalty(problem_));
    return estimate_.wants_residual() ? splitting.iterate_measured() : splitting.iterate();
  }

  // Duals that are rounded in every iteration make the weights tremble, of which the estimate of
  // the error cannot tell that it leads nowhere.
  bool trembles(int iteration) const {
    constexpr int kLongest = 300;
    constexpr double kSmallest = 1e-6;
    return iteration >= kLongest ||
           std::max(report_.primal_residual, 1.0) * options_.tolerance < kSmallest;
  }

  const LbcProblem<Dim>& problem_;
  const SolverOptions& options_;
  const bool adaptive_;
  const bool warm_;
  SolveReport& report_;
  const double num_weights_;
  const double residual_scale_;
  splitting::ErrorEstimate estimate_;
  std::optional<splitting::WeightHistory<Scalar>> history_;
  std::function<Certificate()> certificate_;
  GapCriterion gap_;
};

// A factor of a large mesh takes more time and memory than the iteration itself; in 3D soon, in 2D
// where meshes hardly get.
template <int Dim>
LinearSolver linear_solver_for(const LbcProblem<Dim>& problem, const SolverOptions& options) {
  constexpr Index kLargest = Dim == 2 ? 2000000 : 20000;  // vertices
  if (options.linear_solver != LinearSolver::kAuto) return options.linear_solver;
  return problem.mesh.num_vertices() > kLargest ? LinearSolver::kMultigrid : LinearSolver::kDirect;
}

// The coarser the mesh, the more roundings of duals move the weights; and small meshes are fast as
// they are.
template <int Dim>
bool takes_half(const LbcProblem<Dim>& problem, const SolverOptions& options,
                const StateStorage* storage) {
  constexpr Index kFewestCells = 10000;
  return options.precision == Precision::kHalf && problem.mesh.num_cells() >= kFewestCells &&
         (storage == nullptr || storage->holds_half());
}

// The front of what the progress callback is offered.
struct StateFront {
  bool is_half = false;
  double penalty = 0;
  bool warm = false;
};

// Takes it off. \return none where there is no state to go on from
std::optional<StateFront> take_front(ByteReader& read) {
  if (read.is_at_end()) return std::nullopt;
  StateFront front;
  read(front.is_half, front.penalty, front.warm);
  return front;
}

// A fortieth of the cage's size suits everywhere, roughly; adapt_penalty() does the rest.
template <int Dim>
double choose_penalty(const LbcProblem<Dim>& problem, const SolverOptions& options,
                      const StateStorage* storage, const WarmStart<Dim>& warm_start) {
  if (resumes(storage)) return storage->penalty();
  if (options.penalty > 0) return options.penalty;
  if (warm_start.from) return warm_start.from->penalty();
  return bounding_box_diagonal(problem.cage.points) / 40;
}

template <class Scalar, class Stored, int Dim>
void choose_start(ValueSplitting<Scalar, Stored, Dim>& splitting, const StateStorage* storage,
                  const WarmStart<Dim>& warm_start) {
  constexpr int kRichardsonSteps = 8;
  if (resumes(storage)) {
    splitting.resume();
  } else if (warm_start.from) {
    splitting.start_from_duals([&](Index v) { return warm_start.from->weights_at(v); },
                               [&](Index s) { return warm_start.from->flux_density(s); },
                               warm_start.from->vertex_dual_at(splitting.penalty()));
  } else {
    splitting.start_from_harmonic(kRichardsonSteps);
  }
}

template <class Scalar, class Stored, int Dim>
MeshState<Dim> keep_state(ValueSplitting<Scalar, Stored, Dim>& splitting,
                          const LbcProblem<Dim>& problem) {
  MeshState<Dim> state;
  state.penalty = splitting.penalty();
  state.weights = splitting.weights();
  state.vertex_dual = splitting.vertex_dual();
  state.flux_density = flux_densities(problem, splitting.flux());
  return state;
}

// Leaves everything where it is wanted.
template <class Scalar, class Stored, int Dim>
MethodResult end(ValueSplitting<Scalar, Stored, Dim>& splitting, const LbcProblem<Dim>& problem,
                 std::function<Certificate(const WeightMatrix&)> certify_weights,
                 StateStorage* storage, MeshState<Dim>* final_state, SolveReport& report) {
  splitting.finish();
  report.state_scalars_per_cell = splitting.state_scalars_per_cell();
  report.penalty = splitting.penalty();
  if (storage != nullptr) storage->keep_penalty(report.penalty);
  if (final_state) *final_state = keep_state(splitting, problem);
  return {splitting.weights(), std::move(certify_weights)};
}

template <class Scalar, class Stored, int Dim>
MethodResult solve(const LbcProblem<Dim>& problem, const SolverOptions& options,
                   SolveReport& report, StateStorage* storage, WarmStart<Dim> warm_start) {
  Stopwatch watch;
  const auto metric =
      splitting::measure_metric(problem, options.non_negative == NonNegative::kConstraint);
  ByteReader read(options.resume_from);
  const auto front = take_front(read);
  const double penalty =
      front ? front->penalty : choose_penalty(problem, options, storage, warm_start);
  auto splitting = std::make_shared<ValueSplitting<Scalar, Stored, Dim>>(
      problem, metric, penalty, options.relaxation, linear_solver_for(problem, options), storage);
  if (front) {
    splitting->visit(read);
  } else {
    choose_start(*splitting, storage, warm_start);
  }
  const bool warm = front ? front->warm : warm_start.from != nullptr;
  if (warm_start.started) warm_start.started();
  const bool adaptive = options.penalty == 0 && !resumes(storage) && !warm;
  const auto certify_by = [&problem](const auto& any) {
    return [any, &problem](const WeightMatrix& weights) {
      return certify(problem, any->flux(), weights);
    };
  };
  report.iterations = 0;
  Run<Scalar, Dim> run(problem, metric.cell.sum(), options, adaptive, warm, report);
  if (front) run.resume(read, *splitting);
  const auto end_with = [&](const auto& any) {
    report.seconds.solve = watch.lap();
    return end(*any, problem, certify_by(any), storage, warm_start.final_state, report);
  };
  [[maybe_unused]] const bool has_ended = run.iterate(*splitting, certify_by(splitting));
  if constexpr (std::is_same_v<Stored, compact::Half>) {
    if (!has_ended) {
      const auto single =
          std::make_shared<ValueSplitting<Scalar, Scalar, Dim>>(std::move(*splitting), storage);
      splitting.reset();
      run.iterate(*single, certify_by(single));
      return end_with(single);
    }
  }
  return end_with(splitting);
}

}  // namespace

template <int Dim>
MethodResult solve_by_value(const LbcProblem<Dim>& problem, const SolverOptions& options,
                            SolveReport& report, StateStorage* storage, WarmStart<Dim> warm_start) {
  if (options.precision == Precision::kDouble) {
    return solve<double, double>(problem, options, report, storage, warm_start);
  }
  ByteReader read(options.resume_from);
  const auto front = take_front(read);
  if (front ? front->is_half : takes_half(problem, options, storage)) {
    return solve<float, compact::Half>(problem, options, report, storage, warm_start);
  }
  return solve<float, float>(problem, options, report, storage, warm_start);
}

template MethodResult solve_by_value(const LbcProblem<2>&, const SolverOptions&, SolveReport&,
                                     StateStorage*, WarmStart<2>);
template MethodResult solve_by_value(const LbcProblem<3>&, const SolverOptions&, SolveReport&,
                                     StateStorage*, WarmStart<3>);

}  // namespace flbc
