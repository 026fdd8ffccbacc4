// SPDX-License-Identifier: BSD-3-Clause
// Method::kValue from start to weights.
#include <algorithm>
#include <memory>

#include "base/stopwatch.h"
#include "flbc/bounding_box.h"
#include "flbc/certificate.h"
#include "solver/iterative_method.h"
#include "solver/splitting/compact_splitting.h"
#include "solver/splitting/error_estimate.h"
#include "solver/splitting/half_then_single.h"

namespace flbc {
namespace {

// The penalty grows to no more than this: what is balanced are lengths of all that moves, and where
// the start is nearly right everywhere, as on round cages, that takes the penalty out of the range
// in which the rest converges.
template <int Dim>
double largest_penalty(const LbcProblem<Dim>& problem) {
  return bounding_box_diagonal(problem.cage.points) / 30;
}

//! \param measure  of the domain
template <class Splitting, int Dim>
void iterate(Splitting& splitting, const LbcProblem<Dim>& problem,
             double measure, const SolverOptions& options, bool adaptive, bool warm,
             GapCriterion& gap, SolveReport& report) {
  constexpr double kBalance = 0.3;
  constexpr int kFewest = 8;
  const double n = problem.num_control_points();
  const double interior =
      problem.mesh.num_vertices() - static_cast<double>(problem.boundary.vertices.size());
  const double num_weights = std::max(1.0, interior) * n;
  const double size = bounding_box_diagonal(problem.cage.points);
  const double residual_scale = size * size / (n * measure);
  splitting::ErrorEstimate estimate(warm, options.tolerance);
  auto history = splitting.history();
  const auto read = [&](Index row, auto* weights) { splitting.read_row(row, weights); };
  history(0, read);
  const auto step_at = [&](int iteration) {
    const bool adapts = iteration == 5 || iteration == 10 || iteration == 20 || iteration == 40;
    if (adaptive && adapts) return splitting.iterate_and_adapt(kBalance, largest_penalty(problem));
    return estimate.wants_residual() ? splitting.iterate_measured() : splitting.iterate();
  };
  for (int iteration = 1;; ++iteration) {
    const auto step = step_at(iteration);
    const double difference = history(iteration, read) / n;
    report.iterations = iteration;
    report.primal_residual = estimate(iteration, step.change / num_weights, difference,
                                      step.violation * residual_scale) /
                             options.tolerance;
    const bool look = iteration % options.check_interval == 0 ||
                      (iteration >= kFewest && report.primal_residual <= 1) ||
                      iteration == options.max_iterations;
    if (look && finished(iteration, options, gap, report)) return;
  }
}

// A factor of a large mesh takes more time and memory than the iteration itself; in 3D soon, in 2D
// where meshes hardly get.
template <int Dim>
LinearSolver linear_solver_for(const LbcProblem<Dim>& problem, const SolverOptions& options) {
  constexpr Index kLargest = Dim == 2 ? 2000000 : 20000;  // vertices
  if (options.linear_solver != LinearSolver::kAuto) return options.linear_solver;
  return problem.mesh.num_vertices() > kLargest ? LinearSolver::kMultigrid : LinearSolver::kDirect;
}

// Duals that are rounded in every iteration make the weights tremble, the more the coarser the mesh;
// and small meshes are fast as they are.
template <int Dim>
bool takes_half(const LbcProblem<Dim>& problem, const SolverOptions& options,
                const StateStorage* storage) {
  constexpr Index kFewestCells = 10000;
  return options.precision == Precision::kHalf && problem.mesh.num_cells() >= kFewestCells &&
         (storage == nullptr || storage->holds_half());
}

bool resumes(const StateStorage* storage) {
  return storage != nullptr && storage->penalty() > 0;
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

template <class Splitting, int Dim>
void choose_start(Splitting& splitting, const StateStorage* storage,
                  const WarmStart<Dim>& warm_start) {
  constexpr int kRichardsonSteps = 8;
  if (resumes(storage)) {
    splitting.resume();
  } else if (warm_start.from) {
    splitting.start_from_duals(
        warm_start.from->weights(), [&](Index s) { return warm_start.from->flux_density(s); },
        warm_start.from->vertex_dual(splitting.penalty()));
  } else {
    splitting.start_from_harmonic(kRichardsonSteps);
  }
}

template <class Splitting, int Dim>
MeshState<Dim> keep_state(Splitting& splitting, const LbcProblem<Dim>& problem) {
  MeshState<Dim> state;
  state.penalty = splitting.penalty();
  state.weights = splitting.weights();
  state.vertex_dual = splitting.vertex_dual();
  state.flux_density = flux_densities(problem, splitting.flux());
  return state;
}

template <class Splitting, int Dim>
MethodResult solve(const LbcProblem<Dim>& problem, const SolverOptions& options,
                   SolveReport& report, StateStorage* storage, WarmStart<Dim> warm_start) {
  Stopwatch watch;
  const auto metric =
      splitting::measure_metric(problem, options.non_negative == NonNegative::kConstraint);
  auto splitting = std::make_shared<Splitting>(
      problem, metric, choose_penalty(problem, options, storage, warm_start), options.relaxation,
      linear_solver_for(problem, options), storage);
  choose_start(*splitting, storage, warm_start);
  const bool adaptive = options.penalty == 0 && !resumes(storage) && !warm_start.from;
  const auto certify_weights = [splitting, &problem](const WeightMatrix& weights) {
    return certify(problem, splitting->flux(), weights);
  };
  GapCriterion gap(*options.gap, [&] { return certify_weights(splitting->weights()); });
  const auto told = with_objective(problem, options, [&] { return splitting->weights(); });
  iterate(*splitting, problem, metric.cell.sum(), told, adaptive, warm_start.from != nullptr, gap,
          report);
  splitting->finish();
  report.state_scalars_per_cell = splitting->state_scalars_per_cell();
  report.penalty = splitting->penalty();
  if (storage != nullptr) storage->keep_penalty(report.penalty);
  report.seconds.solve = watch.lap();
  if (warm_start.final_state) *warm_start.final_state = keep_state(*splitting, problem);
  return {splitting->weights(), certify_weights};
}

}  // namespace

template <int Dim>
MethodResult solve_by_value(const LbcProblem<Dim>& problem, const SolverOptions& options,
                            SolveReport& report, StateStorage* storage, WarmStart<Dim> warm_start) {
  using Double = compact::CompactSplitting<double, double, Dim>;
  using Single = compact::CompactSplitting<float, float, Dim>;
  using Half = compact::HalfThenSingle<Dim>;
  if (options.precision == Precision::kDouble) {
    return solve<Double>(problem, options, report, storage, warm_start);
  }
  if (takes_half(problem, options, storage)) {
    return solve<Half>(problem, options, report, storage, warm_start);
  }
  return solve<Single>(problem, options, report, storage, warm_start);
}

template MethodResult solve_by_value(const LbcProblem<2>&, const SolverOptions&, SolveReport&,
                                     StateStorage*, WarmStart<2>);
template MethodResult solve_by_value(const LbcProblem<3>&, const SolverOptions&, SolveReport&,
                                     StateStorage*, WarmStart<3>);

}  // namespace flbc
