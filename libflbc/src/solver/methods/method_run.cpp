// SPDX-License-Identifier: BSD-3-Clause
#include "solver/methods/method_run.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "base/instantiate.h"
#include "base/stopwatch.h"
#include "flbc/errors.h"
#include "mesh/cell_geometry.h"
#include "solver/methods/active_set/active_splitting.h"
#include "solver/methods/splitting/compact_splitting.h"
#include "solver/plan/choices.h"
#include "solver/plan/constants.h"

namespace flbc {
namespace {

// A penalty in published units of length relative to one in problem units.
template <int Dim>
double published_unit(const LbcProblem<Dim>& problem, Method method) {
  return plan::penalty_unit(method, Dim, plan::published_scale(problem.mesh));
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
  parameters.relaxation = settings.relaxation;
  parameters.linear_solver = plan::linear_solver(plan::sizes_of(problem), settings.method);
  return parameters;
}

// Method::kWeights. \param part  factor of the automatic penalty
template <int Dim>
splitting::Parameters weights_parameters(const LbcProblem<Dim>& problem,
                                         const plan::Settings& settings, double part = 1) {
  auto parameters = common_parameters(
      problem, settings, plan::kPenalty + plan::kPenaltyOfSmoothness * problem.smoothness);
  if (!settings.penalty) parameters.part = part;
  return parameters;
}

// Method::kLbc2014: the augmented Lagrangian of (2), in which the weight of a cell is its squared
// measure. With a given penalty, W = w has the same weight as all other constraints. Otherwise,
// penalty and weight of W = w match those of kWeights on average. In published units W = w has
// weight 1; relative to squared cell measures this is length^-(2 Dim - 2) here.
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
std::unique_ptr<Iteration<Dim>> make_gradient(const LbcProblem<Dim>& problem,
                                              const plan::Settings& settings) {
  if (const auto make = gradient_iteration<Dim>()) return make(problem, settings);
  throw OptionError(
      std::string("method ") + (settings.method == Method::kPaper ? "paper" : "gradient") +
      " iterates on a mesh of OpenMesh: link flbc::openmesh, or choose method weights");
}

}  // namespace

template <int Dim>
MakeIteration<Dim>& gradient_iteration() {
  static MakeIteration<Dim> make = nullptr;
  return make;
}

template <int Dim>
StopRule MethodRun<Dim>::make_stop_rule(const plan::Settings& settings) const {
  const auto n = static_cast<double>(problem_->num_control_points());
  const double length = plan::published_scale(problem_->mesh);
  switch (settings.method) {
    case Method::kWeights:
      return StopRule::estimate(
          1 / (n * std::max(1.0, double(problem_->boundary.interior_vertices().size()))),
          iteration_->interval());
    case Method::kGradient:
      return StopRule::estimate(plan::kSquaredWeightOfGradient / (n * problem_->mesh.num_cells()),
                                iteration_->interval());
    case Method::kPaper:
      // r_p has the unit of gradients, 1 / length, and r_d is mu times that.
      return StopRule::residuals(1 / length, std::pow(length, Dim));
    default:
      // Gradients times a measure, and rho times that.
      return StopRule::residuals(std::pow(length, Dim - 1), 1);
  }
}

// \return whether an active set pays
template <int Dim>
bool MethodRun<Dim>::begin_on_active_set(const plan::Settings& settings,
                                         const RunStart<Dim>& start) {
  const auto sizes = plan::sizes_of(*problem_);
  if (!plan::active_set(sizes, settings)) return false;
  const bool cold = start.from == nullptr;
  active_set::HarmonicStart<Dim> harmonic;
  if (cold) {
    harmonic = active_set::harmonic_start(*problem_, plan::linear_solver(sizes, settings.method));
  }
  const double threshold = active_set::threshold_for(*settings.tolerance);
  auto active = plan::active_set_is_complete(sizes, settings, cold)
                    ? active_set::all_allowed(*problem_)
                : cold ? std::move(harmonic.active)
                       : active_set::active_from(*problem_, *start.from, threshold);
  if (start.supports != nullptr) {
    active = active_set::joined(*problem_, active,
                                active_set::active_from(*problem_, *start.supports, threshold));
  }
  if (!plan::active_set_pays(active_set::density(*problem_, active), sizes, settings)) return false;
  const auto from = cold ? harmonic.start : start.from->start();
  const auto parameters = weights_parameters(
      *problem_, settings, cold ? plan::kActivePenaltyCold : plan::kActivePenaltyWarm);
  iteration_ = make_in<active_set::ActiveSplitting>(
      settings.precision, *problem_, metric_of(*problem_, settings), parameters, std::move(active));
  iteration_->start(from);
  return true;
}

template <int Dim>
void MethodRun<Dim>::begin(const plan::Settings& settings, const RunStart<Dim>& start) {
  is_active_ = begin_on_active_set(settings, start);
  if (is_active_) return;
  if (settings.method == Method::kWeights) {
    iteration_ = make_in<compact::CompactSplitting>(settings.precision, *problem_,
                                                    metric_of(*problem_, settings),
                                                    weights_parameters(*problem_, settings));
    iteration_->start(start.from != nullptr ? start.from->start() : Start<Dim>{});
    return;
  }
  iteration_ = settings.method == Method::kLbc2014 ? make_lbc2014(*problem_, settings)
                                                   : make_gradient(*problem_, settings);
  iteration_->start({});
}

template <int Dim>
Weights MethodRun<Dim>::solve(const plan::Settings& settings, const Reporter& reporter,
                              SolveReport& report, RunStart<Dim> start) {
  Stopwatch watch;
  report = {};
  report.method = settings.method;
  report.control_points = problem_->num_control_points();
  report.vertices = problem_->mesh.num_vertices();
  report.cells = problem_->mesh.num_cells();
  if (is_active_ && plan::proves(settings) && !can_certify()) iteration_ = nullptr;
  if (!iteration_) {
    begin(settings, start);
    state_ = RunState{make_stop_rule(settings)};
  }
  if (start.started) start.started();
  run(*iteration_, *state_, {*problem_, settings, reporter}, report);
  iteration_->describe(report);
  report.seconds.solve = watch.lap();
  auto weights = iteration_->weights();
  report.seconds.recover = watch.lap();
  require_finite(weights.is_sparse() || weights.dense.allFinite(), report);
  report.published_penalty = report.penalty * published_unit(*problem_, settings.method);
  return weights;
}

template <int Dim>
WarmStart<Dim> MethodRun<Dim>::warm_start(double least_weight) const {
  auto state = iteration_->state();
  if (least_weight > 0 && !is_active_) {
    state.flux_density = active_set::where_weights_are(*problem_, state, least_weight);
  }
  return keep(*problem_, state);
}

FLBC_INSTANTIATE_FUNCTION(gradient_iteration)
template class MethodRun<2>;
template class MethodRun<3>;

}  // namespace flbc
