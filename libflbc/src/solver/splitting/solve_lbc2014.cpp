// SPDX-License-Identifier: BSD-3-Clause
// Method::kLbc2014 from start to weights.
#include <memory>

#include "base/stopwatch.h"
#include "flbc/bounding_box.h"
#include "flbc/certificate.h"
#include "solver/iterative_method.h"
#include "solver/splitting/weight_splitting.h"
#include "solver/state_storage.h"

namespace flbc {
namespace {

template <class Scalar, int Dim>
using Splitting = splitting::WeightSplitting<Scalar, Dim>;

// The constraints Z = grad w scaled by the measure, and W = w.
//! \param vertex_weight  of |W - w|^2; 1 as published, 0 for the one that suits the mesh
template <int Dim>
splitting::Metric metric_2014(const LbcProblem<Dim>& problem, bool non_negative,
                              double vertex_weight) {
  const auto measures = splitting::cell_measures(problem.mesh);
  splitting::Metric metric;
  metric.cell = measures.array().square();
  if (!non_negative) return metric;
  if (vertex_weight == 0) {
    vertex_weight =
        splitting::measure_metric(problem, true).vertex.mean() * metric.cell.sum() / measures.sum();
  }
  metric.vertex = Eigen::VectorXd::Constant(problem.mesh.num_vertices(), vertex_weight);
  return metric;
}

// What the penalty has to be multiplied by to act as kValue's, whose metric is the measure: rho m is
// the same multiple of the measure then, on average.
double penalty_of_measure(const splitting::Metric& metric) {
  return metric.cell.sum() / metric.cell.cwiseSqrt().sum();
}

template <int Dim>
double choose_penalty(const LbcProblem<Dim>& problem, const splitting::Metric& metric,
                      const SolverOptions& options, const StateStorage* storage,
                      const WarmStart<Dim>& warm_start) {
  constexpr double kDiameters = 0.0085;
  if (resumes(storage)) return storage->penalty();
  if (options.penalty > 0) return options.penalty;
  const double of_measure = warm_start.from
                                ? warm_start.from->penalty()
                                : kDiameters * bounding_box_diagonal(problem.cage.points);
  return of_measure / penalty_of_measure(metric);
}

// Ends by the thresholds of section 5 of the paper.
template <class Scalar, int Dim>
void iterate(Splitting<Scalar, Dim>& splitting, const SolverOptions& options, GapCriterion& gap,
             SolveReport& report) {
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

template <class Scalar, int Dim>
void choose_start(Splitting<Scalar, Dim>& splitting, double of_measure, const StateStorage* storage,
                  const WarmStart<Dim>& warm_start) {
  constexpr int kRichardsonSteps = 8;
  if (resumes(storage)) {
    splitting.resume();
  } else if (warm_start.from) {
    splitting.start_from_duals(
        warm_start.from->weights(), [&](Index s) { return warm_start.from->flux_density(s); },
        warm_start.from->vertex_dual(of_measure * splitting.penalty()));
  } else {
    splitting.start_from_harmonic(kRichardsonSteps);
  }
}

template <class Scalar, int Dim>
MeshState<Dim> keep_state(Splitting<Scalar, Dim>& splitting, const LbcProblem<Dim>& problem,
                          double of_measure) {
  MeshState<Dim> state;
  state.penalty = of_measure * splitting.penalty();
  state.weights = splitting.weights();
  state.vertex_dual = splitting.vertex_dual();
  state.flux_density = flux_densities(problem, splitting.flux());
  return state;
}

template <class Scalar, int Dim>
MethodResult solve_in(const LbcProblem<Dim>& problem, const SolverOptions& options,
                   SolveReport& report, StateStorage* storage, WarmStart<Dim> warm_start) {
  Stopwatch watch;
  const auto metric = metric_2014(problem, options.non_negative == NonNegative::kConstraint,
                                  options.penalty > 0 ? 1 : 0);
  const double penalty = choose_penalty(problem, metric, options, storage, warm_start);
  const double of_measure = penalty_of_measure(metric);
  const auto linear_solver =
      options.linear_solver == LinearSolver::kAuto ? LinearSolver::kDirect : options.linear_solver;
  auto splitting = std::make_shared<Splitting<Scalar, Dim>>(
      problem, metric, penalty, options.relaxation, linear_solver, storage);
  choose_start(*splitting, of_measure, storage, warm_start);
  const auto certify_weights = [splitting, &problem](const WeightMatrix& weights) {
    return certify(problem, splitting->flux(), weights);
  };
  GapCriterion gap(*options.gap, [&] { return certify_weights(splitting->weights()); });
  const auto told = with_objective(problem, options, [&] { return splitting->weights(); });
  iterate(*splitting, told, gap, report);
  report.state_scalars_per_cell = splitting->state_scalars_per_cell();
  report.penalty = splitting->penalty();
  if (storage != nullptr) storage->keep_penalty(report.penalty);
  report.seconds.solve = watch.lap();
  if (warm_start.final_state) {
    *warm_start.final_state = keep_state(*splitting, problem, of_measure);
  }
  return {splitting->weights(), certify_weights};
}

}  // namespace

template <int Dim>
MethodResult solve_lbc2014(const LbcProblem<Dim>& problem, const SolverOptions& options,
                           SolveReport& report, StateStorage* storage, WarmStart<Dim> warm_start) {
  return options.precision == Precision::kDouble
             ? solve_in<double>(problem, options, report, storage, warm_start)
             : solve_in<float>(problem, options, report, storage, warm_start);
}

template MethodResult solve_lbc2014(const LbcProblem<2>&, const SolverOptions&, SolveReport&,
                                    StateStorage*, WarmStart<2>);
template MethodResult solve_lbc2014(const LbcProblem<3>&, const SolverOptions&, SolveReport&,
                                    StateStorage*, WarmStart<3>);

}  // namespace flbc
