// SPDX-License-Identifier: BSD-3-Clause
#include "solver/run/stop_rule.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "solver/plan/constants.h"

namespace flbc {

double ErrorEstimate::operator()(double change) {
  if (!std::isfinite(change)) return change;
  ++calls_;
  changes_.push_back(change);
  constexpr std::size_t kKept = plan::kCircle + plan::kLag;
  if (changes_.size() > kKept) changes_.pop_front();
  const auto sum = [](auto begin, auto end) { return std::accumulate(begin, end, 0.0); };
  const auto count = std::min<std::ptrdiff_t>(plan::kCircle, changes_.size());
  const double now = sum(changes_.end() - count, changes_.end());
  if (calls_ == plan::kCircle) first_ = now;
  double rate = plan::kFirstRate;
  if (changes_.size() == kKept && now > 0) {
    const double before = sum(changes_.begin(), changes_.begin() + count);
    // Changes are squares of lengths. They swing, so that the rate since the first ones counts as
    // well. Those of noise or of new duals do not shrink, so the rate is limited.
    rate = std::max(std::pow(now / before, 0.5 / plan::kLag),
                    std::pow(now / first_, 0.5 / (calls_ - plan::kCircle)));
    rate = std::min(rate, std::max(plan::kLargestRate, 1 - plan::kLeastPower / calls_));
  }
  rate = std::pow(rate, 1.0 / interval_);
  return plan::kSafety * now / static_cast<double>(count) * std::pow(rate / (1 - rate), 2);
}

Ratios StopRule::judge(const Step& step, double tolerance, bool counts) {
  if (estimates_) {
    auto estimate = estimate_;
    const Ratios ratios{estimate(primal_ * step.change) / tolerance, 0};
    if (counts) estimate_ = std::move(estimate);
    return ratios;
  }
  constexpr double kDualToPrimal = 10;  // section 5 of the paper: N 1e-7 and N 1e-6
  return {primal_ * step.primal / tolerance, dual_ * step.dual / (kDualToPrimal * tolerance)};
}

}  // namespace flbc
