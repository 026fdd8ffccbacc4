// SPDX-License-Identifier: BSD-3-Clause
// The paper's solver from start to weights.
#include <algorithm>
#include <cmath>
#include <memory>

#include "base/stopwatch.h"
#include "flbc/certificate.h"
#include "flbc/harmonic.h"
#include "flbc/recovery.h"
#include "solver/gradient/gradient_admm.h"
#include "solver/iterative_method.h"

namespace flbc {
namespace {

// Iterates until both residuals are below their thresholds (section 4.2.1 of the paper), the limit
// is reached or the caller stops the run.
template <class Scalar, int Dim>
void iterate(gradient::GradientAdmm<Scalar, Dim>& admm, const SolverOptions& options,
             GapCriterion& gap, SolveReport& report) {
  // The paper's dual threshold is 10 times its primal one; one tolerance keeps their ratio.
  const double components = admm.num_residual_components();
  const double primal_threshold =
      options.tolerance * (options.method == Method::kPaper ? components : std::sqrt(components));
  const double dual_threshold = 10 * primal_threshold;
  for (int iteration = 0;;) {
    const int count = std::min(options.check_interval, options.max_iterations - iteration);
    const auto residuals = admm.residuals(admm.iterate(count));
    iteration += count;
    report.iterations = iteration;
    report.primal_residual = residuals.primal / primal_threshold;
    report.dual_residual = residuals.dual / dual_threshold;
    if (finished(iteration, options, gap, report)) return;
  }
}

template <class Scalar, int Dim>
WeightMatrix recover(gradient::GradientAdmm<Scalar, Dim>& admm, const LbcProblem<Dim>& problem,
                     Recovery recovery) {
  return recovery == Recovery::kBreadthFirst ? integrate_breadth_first(problem, admm.gradients())
                                             : integrate_least_squares(problem, admm.gradients());
}

template <class Scalar, int Dim>
MeshState<Dim> keep_state(gradient::GradientAdmm<Scalar, Dim>& admm, const LbcProblem<Dim>& problem,
                          double penalty) {
  MeshState<Dim> state;
  state.penalty = penalty;
  state.flux_density = flux_densities(problem, admm.flux());
  state.potential =
      flux_potential<Dim>(problem, [&](Index facet) { return admm.facet_multiplier(facet); });
  state.periods = admm.period_factors();
  return state;
}

template <class Scalar, int Dim>
MethodResult solve(const LbcProblem<Dim>& problem, const SolverOptions& options,
                   SolveReport& report, StateStorage* storage, WarmStart<Dim> warm_start) {
  Stopwatch watch;
  auto admm = std::make_shared<gradient::GradientAdmm<Scalar, Dim>>(
      problem, options.penalty, options.relaxation, gradient::boundary_periods(problem), storage);
  if (storage != nullptr && storage->penalty() > 0) {
    // goes on from what is there
  } else if (options.method == Method::kPaper) {
    admm->start_from_least_norm();
  } else if (warm_start.from) {
    admm->start_from_duals(
        warm_start.from->weights(), [&](Index s) { return warm_start.from->flux_density(s); },
        [&](Index facet) { return warm_start.from->facet_multiplier(facet); },
        warm_start.from->periods());
  } else {
    admm->start_from_weights(harmonic_coordinates(problem));
  }
  const auto certify_weights = [admm, &problem](const WeightMatrix& weights) {
    return certify(problem, admm->flux(), weights);
  };
  GapCriterion gap(*options.gap,
                   [&] { return certify_weights(recover(*admm, problem, options.recovery)); });
  iterate(*admm, options, gap, report);
  report.state_scalars_per_cell = admm->state_scalars_per_cell();
  report.penalty = options.penalty;
  if (storage != nullptr) storage->keep_penalty(options.penalty);
  report.seconds.solve = watch.lap();
  MethodResult result{recover(*admm, problem, options.recovery), certify_weights};
  report.seconds.recover = watch.lap();
  if (warm_start.final_state) {
    *warm_start.final_state = keep_state(*admm, problem, options.penalty);
    warm_start.final_state->weights = result.weights;
  }
  return result;
}

}  // namespace

template <int Dim>
MethodResult solve_by_gradients(const LbcProblem<Dim>& problem, const SolverOptions& options,
                                SolveReport& report, StateStorage* storage,
                                WarmStart<Dim> warm_start) {
  return options.precision == Precision::kDouble
             ? solve<double>(problem, options, report, storage, warm_start)
             : solve<float>(problem, options, report, storage, warm_start);
}

template MethodResult solve_by_gradients(const LbcProblem<2>&, const SolverOptions&, SolveReport&,
                                         StateStorage*, WarmStart<2>);
template MethodResult solve_by_gradients(const LbcProblem<3>&, const SolverOptions&, SolveReport&,
                                         StateStorage*, WarmStart<3>);

}  // namespace flbc
