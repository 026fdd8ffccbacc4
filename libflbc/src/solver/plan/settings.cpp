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

bool has_default_gap(const SolverOptions& options, Method method, NonNegative non_negative) {
  const bool by_default = method == Method::kValue || method == Method::kGradient;
  return by_default && non_negative != NonNegative::kOff && !options.gap && !options.tolerance;
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
  Settings settings{options};
  const auto method = options.method == Method::kAuto ? Method::kValue : options.method;
  settings.method = method;
  settings.smoothness = options.smoothness.value_or(0);
  settings.non_negative = choose_non_negative(method, options.non_negative);
  if (options.coarse_to_fine == CoarseToFine::kOn && !options.coarse_levels.coarsest) {
    settings.coarse_levels.coarsest = kCoarsest;
  }
  settings.tolerance =
      options.tolerance.value_or(method == Method::kGradient ? kGradientTolerance : kTolerance);
  // The default gap waits for settled weights. A gap that is asked for means what it says.
  settings.gap_settles = has_default_gap(options, method, settings.non_negative);
  settings.gap = options.gap.value_or(settings.gap_settles ? kGap : 0);
  settings.relaxation =
      options.relaxation.value_or(choose_relaxation(method, options.penalty.has_value()));
  return settings;
}

void make_smooth(SolverOptions& options) {
  if (!options.smoothness && plan::smooths(options.method)) {
    options.smoothness = kDeformationSmoothness;
  }
}

SolverOptions resolve(SolverOptions options) {
  return plan::settings_of(options);
}

}  // namespace flbc
