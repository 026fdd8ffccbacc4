// SPDX-License-Identifier: BSD-3-Clause
#include "solver/methods/method_run.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/stopwatch.h"
#include "flbc/errors.h"
#include "mesh/cell_geometry.h"
#include "solver/methods/active_set/active_splitting.h"
#include "solver/methods/gradient/gradient_iteration.h"
#include "solver/methods/splitting/compact_splitting.h"
#include "solver/plan/choices.h"
#include "solver/plan/constants.h"

namespace flbc {
namespace {

template <int Dim>
Origin origin_of(const Transfer<Dim>* from) {
  if (from == nullptr) return Origin::kCold;
  return from->is_between_shapes() ? Origin::kNearby : Origin::kCoarserMesh;
}

// A penalty in published units of length relative to one in problem units.
template <int Dim>
double published_unit(const LbcProblem<Dim>& problem, Method method) {
  return plan::penalty_unit(method, Dim, plan::published_scale(problem.mesh));
}

// For kPaper, r_p has the unit of gradients, 1 / length, and r_d is mu times that. For kLbc2014
// they are gradients times a measure, and rho times that.
template <int Dim>
std::unique_ptr<StopRule<Dim>> published_criterion(const LbcProblem<Dim>& problem, Method method) {
  using Rule = PublishedCriterion<Dim>;
  const double length = plan::published_scale(problem.mesh);
  if (method == Method::kPaper) return std::make_unique<Rule>(1 / length, std::pow(length, Dim));
  return std::make_unique<Rule>(std::pow(length, Dim - 1), 1);
}

// The sum of squared measures divided by the sum of measures.
template <int Dim>
double typical_measure(const LbcProblem<Dim>& problem) {
  const Eigen::VectorXd measures = cell_measures(problem.mesh);
  return measures.squaredNorm() / measures.sum();
}

template <int Dim>
splitting::Metric metric_of(const LbcProblem<Dim>& problem, const plan::Settings& settings) {
  return splitting::measure_metric(problem, settings.non_negative == NonNegative::kConstraint);
}

template <template <class, int> class Method, int Dim, class... Arguments>
std::unique_ptr<Iteration<Dim>> make_in(Precision precision, const LbcProblem<Dim>& problem,
                                        Arguments&&... arguments) {
  if (precision == Precision::kDouble) {
    return std::make_unique<Method<double, Dim>>(problem, std::forward<Arguments>(arguments)...);
  }
  return std::make_unique<Method<float, Dim>>(problem, std::forward<Arguments>(arguments)...);
}

template <int Dim>
splitting::Parameters common_parameters(const LbcProblem<Dim>& problem,
                                        const plan::Settings& settings, double penalty) {
  splitting::Parameters parameters;
  parameters.penalty = settings.penalty.value_or(penalty);
  parameters.relaxation = *settings.relaxation;
  parameters.linear_solver = plan::linear_solver(plan::sizes_of(problem), settings);
  return parameters;
}

// Method::kValue. \param from  its start, or cold
template <int Dim>
splitting::Parameters value_parameters(const LbcProblem<Dim>& problem,
                                       const plan::Settings& settings, const Transfer<Dim>* from) {
  const bool cold = from == nullptr;
  auto parameters = common_parameters(
      problem, settings,
      cold ? plan::with_smoothness(plan::kFirstPenalty, problem.smoothness) : from->penalty());
  parameters.half = plan::half_precision(problem.mesh.num_cells(), settings);
  parameters.balances = cold && !settings.penalty;
  return parameters;
}

// Method::kLbc2014: the augmented Lagrangian of (2), in which the weight of a cell is its squared
// measure. With a given penalty, W = w has the same weight as all other constraints. Otherwise,
// penalty and weight of W = w match those of kValue on average. In published units W = w has weight
// 1; relative to squared cell measures this is length^-(2 Dim - 2) here.
template <int Dim>
std::unique_ptr<Iteration<Dim>> make_lbc2014(const LbcProblem<Dim>& problem,
                                             const plan::Settings& settings) {
  const bool chosen = !settings.penalty;
  const double measure = typical_measure(problem);
  const auto like_value = metric_of(problem, settings);
  double vertex_weight = 0;
  if (like_value.vertex.size() > 0) {
    vertex_weight = chosen ? measure * like_value.vertex.mean()
                           : std::pow(plan::published_scale(problem.mesh), 2 - 2 * Dim);
  }
  auto parameters = common_parameters(problem, settings, plan::kLbc2014Penalty / measure);
  // If W = w has a large weight, the existing factor needs hundreds of solves for harmonic
  // coordinates.
  parameters.harmonic_cold = !chosen;
  parameters.paper_residuals = true;
  return make_in<compact::CompactSplitting>(
      settings.precision, problem, splitting::squared_measure_metric(problem, vertex_weight),
      parameters);
}

template <int Dim>
double gradient_penalty(const LbcProblem<Dim>& problem, const plan::Settings& settings) {
  if (settings.penalty) return *settings.penalty;
  if (settings.method == Method::kPaper) {
    return plan::published_gradient_penalty(Dim) / published_unit(problem, settings.method);
  }
  const double length = std::pow(typical_measure(problem), 1.0 / Dim);
  return plan::gradient_penalty(Dim) * std::pow(length, Dim - 1);
}

template <int Dim>
std::unique_ptr<Iteration<Dim>> make_gradient(const LbcProblem<Dim>& problem,
                                              const plan::Settings& settings) {
  gradient::Parameters parameters;
  parameters.penalty = gradient_penalty(problem, settings);
  parameters.relaxation = *settings.relaxation;
  parameters.harmonic =
      settings.method == Method::kGradient && settings.linear_solver != LinearSolver::kNone;
  parameters.breadth_first =
      settings.method == Method::kPaper || settings.linear_solver == LinearSolver::kNone;
  parameters.linear_solver = plan::linear_solver(plan::sizes_of(problem), settings);
  return make_in<gradient::GradientIteration>(settings.precision, problem, parameters);
}

}  // namespace

template <int Dim>
std::unique_ptr<StopRule<Dim>> MethodRun<Dim>::make_stop_rule(const plan::Settings& settings,
                                                              const WarmStart<Dim>& start) const {
  const bool in_double = settings.precision == Precision::kDouble;
  switch (settings.method) {
    case Method::kValue: {
      const bool looks = !start.for_finer_mesh && problem_->smoothness == 0;
      return std::make_unique<EstimatedError<Dim>>(*problem_, *iteration_, in_double,
                                                   origin_of(start.from), looks);
    }
    case Method::kGradient:
      return std::make_unique<RecoveredError<Dim>>(*problem_, *iteration_, in_double);
    default:
      return published_criterion(*problem_, settings.method);
  }
}

// \return whether an active set pays
template <int Dim>
bool MethodRun<Dim>::begin_on_active_set(const plan::Settings& settings,
                                         const WarmStart<Dim>& start) {
  const auto sizes = plan::sizes_of(*problem_);
  if (!plan::active_set(sizes, settings)) return false;
  const bool cold = start.from == nullptr;
  active_set::ColdStart<Dim> harmonic;
  if (cold) {
    harmonic = start.cold != nullptr
                   ? *start.cold
                   : active_set::cold_start(*problem_, plan::linear_solver(sizes, settings));
  }
  auto active = cold ? std::move(harmonic.active)
                     : active_set::active_from(*problem_, *start.from,
                                               active_set::threshold_for(*settings.tolerance));
  if (!plan::active_set_pays(active_set::density(*problem_, active), settings)) return false;
  const auto from = cold ? harmonic.start : start.from->start();
  auto parameters = value_parameters(*problem_, settings, start.from);
  if (!settings.penalty) {
    parameters.part = cold ? plan::kActivePenaltyCold : plan::kActivePenaltyWarm;
  }
  iteration_ = make_in<active_set::ActiveSplitting>(
      settings.precision, *problem_, metric_of(*problem_, settings), parameters, std::move(active));
  iteration_->start(from);
  return true;
}

template <int Dim>
void MethodRun<Dim>::begin(const plan::Settings& settings, const WarmStart<Dim>& start) {
  is_active_ = begin_on_active_set(settings, start);
  if (is_active_) return;
  if (settings.method == Method::kValue) {
    auto parameters = value_parameters(*problem_, settings, start.from);
    // A finer mesh needs the penalty of the first iterations.
    parameters.looks = !settings.penalty && !start.for_finer_mesh;
    iteration_ = make_in<compact::CompactSplitting>(settings.precision, *problem_,
                                                    metric_of(*problem_, settings), parameters);
    iteration_->start(start.from != nullptr ? start.from->start() : Start<Dim>{});
    return;
  }
  iteration_ = settings.method == Method::kLbc2014 ? make_lbc2014(*problem_, settings)
                                                   : make_gradient(*problem_, settings);
  iteration_->start({});
}

template <int Dim>
Weights MethodRun<Dim>::solve(const plan::Settings& given, const Reporter& reporter,
                              SolveReport& report, WarmStart<Dim> start) {
  Stopwatch watch;
  report = {};
  report.method = given.method;
  report.control_points = problem_->num_control_points();
  report.vertices = problem_->mesh.num_vertices();
  report.cells = problem_->mesh.num_cells();
  auto settings = given;
  if (is_active_ && plan::proves(settings)) iteration_ = nullptr;
  if (!iteration_) {
    begin(settings, start);
    state_ = {make_stop_rule(settings, start)};
    // Meanwhile, small changes do not imply a small error.
    if (is_active_ && start.from == nullptr) {
      state_.earliest = plan::kUntilDualsAreThere;
      if (start.for_finer_mesh) {
        settings.max_iterations = std::min(settings.max_iterations, plan::kUntilDualsAreThere);
      }
    }
  }
  if (start.started) start.started();
  if (is_active_) settings.gap = 0;
  run(*iteration_, state_, {*problem_, settings, reporter}, report);
  iteration_->describe(report);
  report.seconds.solve = watch.lap();
  auto weights = iteration_->weights();
  report.seconds.recover = watch.lap();
  require_finite(weights.is_sparse() || weights.dense.allFinite(), report);
  report.published_penalty = report.penalty * published_unit(*problem_, settings.method);
  return weights;
}

template <int Dim>
Duals<Dim> MethodRun<Dim>::duals(double least_weight) const {
  auto state = iteration_->state();
  if (least_weight > 0 && !is_active_) {
    state.flux_density = active_set::where_weights_are(*problem_, state, least_weight);
  }
  return keep(*problem_, state);
}

template class MethodRun<2>;
template class MethodRun<3>;

}  // namespace flbc
