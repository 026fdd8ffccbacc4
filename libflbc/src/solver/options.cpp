// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/options.h"

#include <cmath>

#include "base/messages.h"
#include "flbc/errors.h"

namespace flbc {
namespace {

void require(bool valid, const char* field, double value, const char* range) {
  if (valid) return;
  throw OptionError(std::string(field) + " must be " + range + ", not " + format_number(value));
}

NonNegative resolved_non_negative(const SolverOptions& options) {
  if (options.non_negative != NonNegative::kAuto) return options.non_negative;
  switch (options.method) {
    case Method::kAuto:
    case Method::kValue:
    case Method::kLbc2014:
      return NonNegative::kConstraint;
    case Method::kGradient:
      return NonNegative::kProject;
    default:
      return NonNegative::kOff;
  }
}

// \param options  with the method resolved, and the tolerance as given
double resolved_gap(const SolverOptions& options) {
  // As near the optimum as tolerances bring other cages; in half precision gaps of about 4e-4 stay.
  constexpr double kGap = 1e-3;
  if (options.gap) return *options.gap;
  const bool by_default = options.method == Method::kValue || options.method == Method::kGradient;
  return by_default && options.tolerance == 0 && options.non_negative != NonNegative::kOff ? kGap
                                                                                           : 0;
}

void validate_gap(const SolverOptions& options, bool iterative) {
  const double gap = options.gap.value_or(0);
  require(std::isfinite(gap) && gap >= 0, "gap", gap, "positive, or 0 for none");
  if (gap == 0) return;
  if (!iterative) throw OptionError("gap needs a method that minimises, which this one does not");
  if (resolved_non_negative(options) == NonNegative::kOff) {
    throw OptionError("gap (--gap) proves nothing of weights that may be negative; choose "
                      "non_negative (--non-negative) constraint or project");
  }
}

void validate(const CoarseLevels& levels) {
  require(levels.coarsest >= 0, "coarse_levels.coarsest", levels.coarsest,
          "a number of vertices, or 0 for where it pays");
  require(levels.factor == 0 || (std::isfinite(levels.factor) && levels.factor >= 2),
          "coarse_levels.factor", levels.factor, "at least 2, or 0 for the one that pays");
  require(std::isfinite(levels.looseness) && levels.looseness > 0, "coarse_levels.looseness",
          levels.looseness, "positive");
}

}  // namespace

void validate(const SolverOptions& options) {
  require(std::isfinite(options.tolerance) && options.tolerance >= 0, "tolerance",
          options.tolerance, "positive, or 0 for the method's own");
  require(options.max_iterations >= 1, "max_iterations", options.max_iterations, "at least 1");
  require(std::isfinite(options.penalty) && options.penalty >= 0, "penalty", options.penalty,
          "positive, or 0 for the method's own");
  require(options.relaxation >= 0 && options.relaxation < 2, "relaxation", options.relaxation,
          "in (0, 2), or 0 for the method's own");
  require(options.check_interval >= 1, "check_interval", options.check_interval, "at least 1");
  const bool splitting = options.method == Method::kAuto || options.method == Method::kValue ||
                         options.method == Method::kLbc2014;
  if (options.non_negative == NonNegative::kConstraint && !splitting) {
    throw OptionError(
        "non_negative cannot be a constraint of this method's iteration; project the weights, or "
        "choose another method");
  }
  const bool iterative =
      options.method != Method::kHarmonic && options.method != Method::kMeanValue;
  if (options.certify && !iterative) {
    throw OptionError("certify needs a method that minimises, which this one does not");
  }
  validate_gap(options, iterative);
  const bool value = options.method == Method::kAuto || options.method == Method::kValue;
  if (options.precision == Precision::kHalf && !value) {
    throw OptionError("precision half is for the method value only; choose single or double");
  }
  const bool gradients = options.method == Method::kGradient || options.method == Method::kPaper;
  if (options.linear_solver == LinearSolver::kNone && !gradients) {
    throw OptionError("linear_solver none is for the methods gradient and paper only");
  }
  require(options.threads >= 0 && options.threads <= 1024, "threads", options.threads,
          "in [1, 1024], or 0 for all");
  validate(options.coarse_levels);
}

SolverOptions resolve(SolverOptions options) {
  if (options.method == Method::kAuto) options.method = Method::kValue;
  const bool gradient = options.method == Method::kGradient;
  const bool paper = options.method == Method::kPaper;
  const bool value = options.method == Method::kValue;
  const bool lbc2014 = options.method == Method::kLbc2014;
  if (options.recovery == Recovery::kAuto) {
    const bool local = paper || (gradient && options.linear_solver == LinearSolver::kNone);
    options.recovery = local ? Recovery::kBreadthFirst : Recovery::kLeastSquares;
  }
  options.non_negative = resolved_non_negative(options);
  options.gap = resolved_gap(options);
  constexpr Index kCoarsest = 500;
  if (options.coarse_to_fine == CoarseToFine::kOn && options.coarse_levels.coarsest == 0) {
    options.coarse_levels.coarsest = kCoarsest;
  }
  if (options.tolerance == 0)
    options.tolerance = gradient ? 1e-6 : 1e-7;
  // Radii in half precision are phi rounded by 1.4e-4 on average. That moves weights by as much on
  // meshes of some dozen cells, squared 1e-8, and by a few 1e-11 squared on models.
  constexpr double kHalfIsEnough = 1e-7;
  if (options.precision == Precision::kAuto) {
    options.precision =
        value && options.tolerance >= kHalfIsEnough ? Precision::kHalf : Precision::kSingle;
  }
  if (options.relaxation == 0) {
    const bool tuned = value || (lbc2014 && options.penalty == 0);
    options.relaxation = tuned ? 1.9 : gradient ? 1.8 : lbc2014 ? 1.65 : 1;
  }
  return options;
}

}  // namespace flbc
