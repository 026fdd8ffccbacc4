// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/options.h"

#include <cmath>

#include "base/messages.h"
#include "flbc/errors.h"
#include "solver/plan/choices.h"

namespace flbc {
namespace {

void require(bool valid, const char* field, double value, const char* range) {
  if (valid) return;
  throw OptionError(std::string(field) + " must be " + range + ", not " + format_number(value));
}

void validate_gap(const SolverOptions& options) {
  const double gap = options.gap.value_or(0);
  require(std::isfinite(gap) && gap >= 0, "gap", gap, "positive, or 0 for none");
  if (gap > 0 && resolve(options).non_negative == NonNegative::kOff) {
    throw OptionError(
        "gap does not apply to weights that may be negative; choose non_negative constraint or "
        "project");
  }
}

void validate_masks(const SolverOptions& options) {
  if (options.masks.empty()) return;
  if (options.method != Method::kWeights) {
    throw OptionError("masks are for the method weights only; leave out masks or method");
  }
  if (options.non_negative == NonNegative::kOff) {
    throw OptionError("masks need weights >= 0; leave out non_negative off");
  }
  if (options.active_set == ActiveSet::kOff) {
    throw OptionError("masks need an active set; leave out active_set off");
  }
}

void validate_reach(const std::vector<double>& reach) {
  constexpr double kMost = 16;
  for (std::size_t i = 0; i < reach.size(); ++i) {
    if (reach[i] >= 1 / kMost && reach[i] <= kMost) continue;
    throw OptionError("reach of control point " + std::to_string(i) +
                      " must be in [1/16, 16], not " + format_number(reach[i]) +
                      "; choose a factor in this range, or a mask for weights of 0");
  }
}

}  // namespace

void validate(const SolverOptions& options) {
  const auto require_positive = [](const char* field, const std::optional<double>& value) {
    require(!value || (std::isfinite(*value) && *value > 0), field, value.value_or(0), "positive");
  };
  require_positive("tolerance", options.tolerance);
  require_positive("penalty", options.penalty);
  const double smoothness = options.smoothness.value_or(0);
  require(std::isfinite(smoothness) && smoothness >= 0, "smoothness", smoothness,
          "positive, or 0 for none");
  require(options.max_iterations >= 1, "max_iterations", options.max_iterations, "at least 1");
  const bool splitting = options.method == Method::kWeights || options.method == Method::kLbc2014;
  if (options.non_negative == NonNegative::kConstraint && !splitting) {
    throw OptionError(
        "non_negative constraint is for the methods weights and lbc2014 only; choose project");
  }
  validate_gap(options);
  validate_masks(options);
  validate_reach(options.reach);
  require(options.falloff >= 0 && options.falloff <= 1, "falloff", options.falloff,
          "in [0, 1], as a part of cage size, or 0 for none");
  if (options.active_set == ActiveSet::kOn && (options.certify || options.gap.value_or(0) > 0)) {
    throw OptionError(
        "active_set on has no certificate, which needs the duals of all pairs; choose active_set "
        "auto, or leave certify and gap out");
  }
  require(options.threads >= 0 && options.threads <= 1024, "threads", options.threads,
          "in [1, 1024], or 0 for all");
  if (smoothness > 0 && !plan::smooths(options.method)) {
    throw OptionError("smoothness is for the methods weights and gradient only");
  }
}

}  // namespace flbc
