// SPDX-License-Identifier: BSD-3-Clause
#include "solver/methods/splitting/penalty_rule.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "solver/plan/constants.h"

namespace flbc::splitting {

PenaltyRule::PenaltyRule(bool balances, bool looks, double smoothness, double part)
    : balances_(balances),
      smoothness_(smoothness),
      part_(part),
      next_look_(looks && smoothness == 0 ? plan::kFirstLook : 0) {
}

Due PenaltyRule::due(int made) const {
  const auto* const last = std::end(plan::kBalancedAfter);
  if (balances_ && std::find(std::begin(plan::kBalancedAfter), last, made) != last) {
    return Due::kBalance;
  }
  return made == next_look_ ? Due::kLook : Due::kNothing;
}

double PenaltyRule::balanced(double penalty, const BalanceLengths& lengths) const {
  const auto [dual2, motion2] = lengths;
  if (!(dual2 > 0) || !(motion2 > 0)) return penalty;
  const double balanced =
      std::min(plan::kBalance * penalty * std::sqrt(dual2 / motion2), plan::kLargestPenalty);
  return part_ * plan::with_smoothness(balanced, smoothness_);
}

double PenaltyRule::after_look(int made, double penalty, double ratio) {
  next_look_ = static_cast<int>(plan::kLookGrowth * made);
  if (ratio < plan::kLeastViolation) {
    const double factor = std::max(ratio / plan::kLeastViolation, plan::kMostLowered);
    settled_ = made + plan::kAfterLook;
    return std::min(penalty, std::max(factor * penalty, plan::kSmallestPenalty));
  }
  if (ratio > plan::kMostViolation) {
    const double factor = std::min(ratio / plan::kMostViolation, plan::kMostRaised);
    return std::max(penalty, std::min(factor * penalty, plan::kLargestPenalty));
  }
  return penalty;
}

}  // namespace flbc::splitting
