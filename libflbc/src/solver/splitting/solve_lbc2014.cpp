// SPDX-License-Identifier: BSD-3-Clause
// Method::kLbc2014 from start to weights.
#include <memory>

#include "base/stopwatch.h"
#include "flbc/bounding_box.h"
#include "flbc/certificate.h"
#include "flbc/harmonic.h"
#include "solver/iterative_method.h"
#include "solver/splitting/weight_splitting.h"

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

// The best penalty makes rho m a multiple of the measure on average: then it acts as kValue's.
template <int Dim>
double penalty_2014(const LbcProblem<Dim>& problem, const splitting::Metric& metric) {
  constexpr double kDiameters = 0.0085;
  return kDiameters * bounding_box_diagonal(problem.cage.points) * metric.cell.cwiseSqrt().sum() /
         metric.cell.sum();
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
MethodResult solve(const LbcProblem<Dim>& problem, const SolverOptions& options,
                   SolveReport& report, StateStorage* storage) {
  Stopwatch watch;
  const auto metric = metric_2014(problem, options.non_negative == NonNegative::kConstraint,
                                  options.penalty > 0 ? 1 : 0);
  const bool resumed = storage != nullptr && storage->penalty() > 0;
  const double penalty = resumed               ? storage->penalty()
                         : options.penalty > 0 ? options.penalty
                                               : penalty_2014(problem, metric);
  const auto linear_solver =
      options.linear_solver == LinearSolver::kAuto ? LinearSolver::kDirect : options.linear_solver;
  auto splitting = std::make_shared<Splitting<Scalar, Dim>>(
      problem, metric, penalty, options.relaxation, linear_solver, storage);
  if (resumed) {
    splitting->resume();
  } else {
    splitting->start_from_weights(harmonic_coordinates(problem));
  }
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
  return {splitting->weights(), certify_weights};
}

}  // namespace

template <int Dim>
MethodResult solve_lbc2014(const LbcProblem<Dim>& problem, const SolverOptions& options,
                           SolveReport& report, StateStorage* storage) {
  return options.precision == Precision::kDouble ? solve<double>(problem, options, report, storage)
                                                 : solve<float>(problem, options, report, storage);
}

template MethodResult solve_lbc2014(const LbcProblem<2>&, const SolverOptions&, SolveReport&,
                                    StateStorage*);
template MethodResult solve_lbc2014(const LbcProblem<3>&, const SolverOptions&, SolveReport&,
                                    StateStorage*);

}  // namespace flbc
