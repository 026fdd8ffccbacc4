// SPDX-License-Identifier: BSD-3-Clause
#include "solver/plan/settings.h"

#include "solver/plan/choices.h"
#include "solver/plan/constants.h"

namespace flbc {
namespace {

NonNegative choose_non_negative(Method method, NonNegative given) {
  if (given != NonNegative::kAuto) return given;
  switch (method) {
    case Method::kWeights:
    case Method::kLbc2014:
      return NonNegative::kConstraint;
    case Method::kGradient:
      return NonNegative::kProject;
    default:
      return NonNegative::kOff;
  }
}

double choose_relaxation(Method method, bool has_penalty) {
  switch (method) {
    case Method::kWeights:
      return plan::kRelaxation;
    case Method::kLbc2014:
      return has_penalty ? plan::kPublishedRelaxation : plan::kRelaxation;
    case Method::kGradient:
      return plan::kGradientRelaxation;
    default:
      return 1;
  }
}

double default_tolerance(const SolverOptions& options) {
  if (!plan::smooths(options.method)) return plan::kPublishedTolerance;
  const bool certifies = options.certify && options.method == Method::kWeights;
  return certifies ? plan::kCertifiedTolerance : plan::kTolerance;
}

}  // namespace

plan::Settings plan::settings_of(const SolverOptions& options) {
  Settings settings{options};
  const auto method = options.method;
  const bool smooths = plan::smooths(method);
  settings.smoothness = options.smoothness.value_or(smooths ? kSmoothness : 0);
  settings.non_negative = choose_non_negative(method, options.non_negative);
  settings.tolerance = options.tolerance.value_or(default_tolerance(options));
  const bool needs_gap = smooths && *settings.smoothness == 0 && !options.tolerance &&
                         settings.non_negative != NonNegative::kOff &&
                         options.active_set != ActiveSet::kOn;
  settings.gap = options.gap.value_or(needs_gap ? kGap : 0);
  settings.ends_by_gap = needs_gap && *settings.gap > 0;
  settings.relaxation = choose_relaxation(method, options.penalty.has_value());
  return settings;
}

SolverOptions resolve(SolverOptions options) {
  return plan::settings_of(options);
}

}  // namespace flbc
