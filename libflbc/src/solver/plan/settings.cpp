// SPDX-License-Identifier: BSD-3-Clause
#include "solver/plan/settings.h"

#include "solver/plan/choices.h"
#include "solver/plan/constants.h"

namespace flbc {
namespace {

NonNegative choose_non_negative(Method method, NonNegative given) {
  if (given != NonNegative::kAuto) return given;
  switch (method) {
    case Method::kValue:
    case Method::kLbc2014:
      return NonNegative::kConstraint;
    case Method::kGradient:
      return NonNegative::kProject;
    default:
      return NonNegative::kOff;
  }
}

// The default gap waits for settled weights. A gap that is asked for means what it says.
plan::GapTarget choose_gap(const SolverOptions& options, Method method, NonNegative non_negative) {
  if (options.gap) return {*options.gap, false};
  const bool by_default = method == Method::kValue || method == Method::kGradient;
  const bool proves = non_negative != NonNegative::kOff;
  if (!by_default || !proves || options.tolerance) return {};
  return {plan::kGap, true};
}

double choose_relaxation(Method method, bool has_penalty) {
  switch (method) {
    case Method::kValue:
      return plan::kRelaxation;
    case Method::kLbc2014:
      return has_penalty ? plan::kPublishedRelaxation : plan::kRelaxation;
    case Method::kGradient:
      return plan::kGradientRelaxation;
    default:
      return 1;
  }
}

}  // namespace

plan::Settings plan::settings_of(const SolverOptions& options) {
  const auto method = options.method == Method::kAuto ? Method::kValue : options.method;
  const auto non_negative = choose_non_negative(method, options.non_negative);
  auto coarse_levels = options.coarse_levels;
  if (options.coarse_to_fine == CoarseToFine::kOn && !coarse_levels.coarsest) {
    coarse_levels.coarsest = kCoarsest;
  }
  return {method,
          options.phi,
          options.smoothness.value_or(0),
          options.distances,
          options.precision,
          non_negative,
          options.linear_solver,
          options.coarse_to_fine,
          coarse_levels,
          options.tolerance.value_or(method == Method::kGradient ? kGradientTolerance : kTolerance),
          choose_gap(options, method, non_negative),
          options.active_set,
          options.max_iterations,
          options.penalty,
          options.relaxation.value_or(choose_relaxation(method, options.penalty.has_value())),
          options.certify,
          options.threads};
}

void make_smooth(SolverOptions& options) {
  if (!options.smoothness && plan::smooths(options.method)) {
    options.smoothness = kDeformationSmoothness;
  }
}

SolverOptions resolve(SolverOptions options) {
  const auto settings = plan::settings_of(options);
  options.method = settings.method;
  options.non_negative = settings.non_negative;
  options.coarse_levels = settings.coarse_levels;
  options.gap = settings.gap.gap;
  options.tolerance = settings.tolerance;
  options.relaxation = settings.relaxation;
  options.smoothness = settings.smoothness;
  return options;
}

}  // namespace flbc
