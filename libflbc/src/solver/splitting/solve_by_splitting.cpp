// SPDX-License-Identifier: BSD-3-Clause
// The two methods that split on the weights, from start to weights. They differ in the metric and
// in what follows from it: the penalty, the start and when to stop.
#include <algorithm>
#include <memory>

#include "base/stopwatch.h"
#include "flbc/bounding_box.h"
#include "flbc/certificate.h"
#include "flbc/harmonic.h"
#include "flbc/recovery.h"
#include "mesh/cell_geometry.h"
#include "problem/laplacian.h"
#include "solver/iterative_method.h"
#include "solver/splitting/error_estimate.h"
#include "solver/splitting/weight_splitting.h"

namespace flbc {
namespace {

template <class Scalar, int Dim>
using Splitting = splitting::WeightSplitting<Scalar, Dim>;

template <int Dim>
Eigen::VectorXd cell_measures(const DomainMesh<Dim>& mesh) {
  Eigen::VectorXd measures(mesh.num_cells());
  for (Index s = 0; s < mesh.num_cells(); ++s) measures[s] = cell_geometry(mesh, s).measure;
  return measures;
}

// ---- kValue: quadratic terms weighted by the measure --------------------------------------------

// The metric of the continuous problem, so that the number of iterations depends on the mesh
// little.
template <int Dim>
splitting::Metric measure_metric(const LbcProblem<Dim>& problem, bool non_negative) {
  // How firmly non-negativity is tied to the gradients: flat between 10 and 300.
  constexpr double kVertexWeight = 100;
  const double size = bounding_box_diagonal(problem.cage.points);
  splitting::Metric metric;
  metric.cell = cell_measures(problem.mesh);
  if (non_negative) metric.vertex = kVertexWeight / (size * size) * lumped_mass(problem.mesh);
  return metric;
}

// The penalty grows to no more than this: what is balanced are lengths of all that moves, and where
// the start is nearly right everywhere, as on round cages, that takes the penalty out of the range
// in which the rest converges.
template <int Dim>
double largest_penalty(const LbcProblem<Dim>& problem) {
  return bounding_box_diagonal(problem.cage.points) / 30;
}

//! \param measure  of the domain
template <class Scalar, int Dim>
void iterate_value(Splitting<Scalar, Dim>& splitting, const LbcProblem<Dim>& problem,
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
  history(0, splitting.data());
  for (int iteration = 1;; ++iteration) {
    const auto step =
        estimate.wants_residual() ? splitting.iterate_measured() : splitting.iterate();
    const double difference = history(iteration, splitting.data()) / n;
    report.iterations = iteration;
    report.primal_residual = estimate(iteration, step.change / num_weights, difference,
                                      step.violation * residual_scale) /
                             options.tolerance;
    const bool adapt =
        adaptive && (iteration == 5 || iteration == 10 || iteration == 20 || iteration == 40);
    if (adapt) splitting.adapt_penalty(kBalance, largest_penalty(problem));
    const bool look = iteration % options.check_interval == 0 ||
                      (iteration >= kFewest && report.primal_residual <= 1) ||
                      iteration == options.max_iterations;
    if (look && finished(iteration, options, gap, report)) return;
  }
}

// ---- kLbc2014: the constraints Z = grad w scaled by the measure, and W = w ----------------------

//! \param vertex_weight  of |W - w|^2; 1 as published, 0 for the one that suits the mesh
template <int Dim>
splitting::Metric metric_2014(const LbcProblem<Dim>& problem, bool non_negative,
                              double vertex_weight) {
  const auto measures = cell_measures(problem.mesh);
  splitting::Metric metric;
  metric.cell = measures.array().square();
  if (!non_negative) return metric;
  if (vertex_weight == 0) {
    vertex_weight =
        measure_metric(problem, true).vertex.mean() * metric.cell.sum() / measures.sum();
  }
  metric.vertex = Eigen::VectorXd::Constant(problem.mesh.num_vertices(), vertex_weight);
  return metric;
}

// The best penalty makes rho m a multiple of the measure on average: then it acts as kValue's.
template <int Dim>
double penalty_2014(const LbcProblem<Dim>& problem, const splitting::Metric& metric) {
  constexpr double kDiameters = 0.0085;
  return kDiameters * bounding_box_diagonal(problem.cage.points) * metric.cell.cwiseSqrt().sum() /
         metric.cell.sum();
}

// Ends by the thresholds of section 5 of the paper.
template <class Scalar, int Dim>
void iterate_2014(Splitting<Scalar, Dim>& splitting, const SolverOptions& options,
                  GapCriterion& gap, SolveReport& report) {
  const double primal_threshold = options.tolerance * splitting.num_residual_components();
  const double dual_threshold = 10 * primal_threshold;
  for (int iteration = 1;; ++iteration) {
    report.iterations = iteration;
    if (iteration % options.check_interval != 0 && iteration < options.max_iterations) {
      splitting.iterate();
      continue;
    }
    const auto residuals = splitting.iterate_with_residuals();
    report.primal_residual = residuals.primal / primal_threshold;
    report.dual_residual = residuals.dual / dual_threshold;
    if (finished(iteration, options, gap, report)) return;
  }
}

// -------------------------------------------------------------------------------------------------

// A factor of a large mesh takes more time and memory than the iteration itself; in 3D soon, in 2D
// where meshes hardly get.
template <int Dim>
LinearSolver linear_solver_for(const LbcProblem<Dim>& problem, const SolverOptions& options) {
  constexpr Index kLargest = Dim == 2 ? 2000000 : 20000;  // vertices
  if (options.linear_solver != LinearSolver::kAuto) return options.linear_solver;
  return options.method == Method::kValue && problem.mesh.num_vertices() > kLargest
             ? LinearSolver::kMultigrid
             : LinearSolver::kDirect;
}

template <class Scalar, int Dim>
MeshState<Dim> keep_state(Splitting<Scalar, Dim>& splitting, const LbcProblem<Dim>& problem) {
  MeshState<Dim> state;
  state.penalty = splitting.penalty();
  state.weights = splitting.weights();
  state.vertex_dual = splitting.vertex_dual();
  state.flux_density = flux_densities(problem, splitting.flux());
  return state;
}

template <class Scalar, int Dim>
MethodResult solve(const LbcProblem<Dim>& problem, const SolverOptions& options,
                   SolveReport& report, StateStorage* storage, WarmStart<Dim> warm_start) {
  Stopwatch watch;
  const bool value = options.method == Method::kValue;
  const bool non_negative = options.non_negative == NonNegative::kConstraint;
  const auto metric = value ? measure_metric(problem, non_negative)
                            : metric_2014(problem, non_negative, options.penalty > 0 ? 1 : 0);
  // A fortieth of the cage's size suits kValue everywhere, roughly; adapt_penalty() does the rest.
  const double first = value ? bounding_box_diagonal(problem.cage.points) / 40 : penalty_2014(problem, metric);
  const bool resumed = storage != nullptr && storage->penalty() > 0;
  const double penalty = resumed               ? storage->penalty()
                         : options.penalty > 0 ? options.penalty
                         : warm_start.from     ? warm_start.from->penalty()
                                               : first;
  auto splitting = std::make_shared<Splitting<Scalar, Dim>>(
      problem, metric, penalty, options.relaxation, linear_solver_for(problem, options), storage);
  if (resumed) {
    splitting->resume();
  } else if (warm_start.from) {
    splitting->start_from_duals(
        warm_start.from->weights(), [&](Index s) { return warm_start.from->flux_density(s); },
        warm_start.from->vertex_dual(penalty));
  } else if (value) {
    constexpr int kRichardsonSteps = 8;
    splitting->start_from_harmonic(kRichardsonSteps);
  } else {
    splitting->start_from_weights(harmonic_coordinates(problem));
  }
  const auto certify_weights = [splitting, &problem](const WeightMatrix& weights) {
    return certify(problem, splitting->flux(), weights);
  };
  GapCriterion gap(*options.gap, [&] { return certify_weights(splitting->weights()); });
  if (value) {
    iterate_value(*splitting, problem, metric.cell.sum(), options,
                  options.penalty == 0 && !resumed && !warm_start.from, warm_start.from != nullptr,
                  gap, report);
  } else {
    iterate_2014(*splitting, options, gap, report);
  }
  report.state_scalars_per_cell = splitting->state_scalars_per_cell();
  report.penalty = splitting->penalty();
  if (storage != nullptr) storage->keep_penalty(report.penalty);
  report.seconds.solve = watch.lap();
  if (warm_start.final_state) *warm_start.final_state = keep_state(*splitting, problem);
  return {splitting->weights(), certify_weights};
}

}  // namespace

template <int Dim>
MethodResult solve_by_splitting(const LbcProblem<Dim>& problem, const SolverOptions& options,
                                SolveReport& report, StateStorage* storage,
                                WarmStart<Dim> warm_start) {
  return options.precision == Precision::kSingle
             ? solve<float>(problem, options, report, storage, warm_start)
             : solve<double>(problem, options, report, storage, warm_start);
}

template MethodResult solve_by_splitting(const LbcProblem<2>&, const SolverOptions&, SolveReport&,
                                         StateStorage*, WarmStart<2>);
template MethodResult solve_by_splitting(const LbcProblem<3>&, const SolverOptions&, SolveReport&,
                                         StateStorage*, WarmStart<3>);

}  // namespace flbc
