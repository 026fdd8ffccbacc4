// SPDX-License-Identifier: BSD-3-Clause
// The rules that end runs, on errors that are known because they are made up.
#include "solver/run/stop_rule.h"

#include <complex>

#include "solver/plan/constants.h"
#include "support/test.h"

namespace flbc {
namespace {

// A sum of modes in directions of their own: amplitude, and factor per iteration.
using Modes = std::vector<std::pair<double, std::complex<double>>>;

// Squared length of the sum after some iterations, or of its last change.
double squared(const Modes& modes, int iteration, bool of_change = false) {
  double sum = 0;
  for (const auto& [amplitude, factor] : modes) {
    const auto part =
        of_change ? std::pow(factor, iteration - 1) * (factor - 1.0) : std::pow(factor, iteration);
    sum += std::norm(amplitude * part);
  }
  return sum;
}

// The smallest and the largest estimate / squared error from the first call that counts on.
std::pair<double, double> extreme_ratios(const Modes& modes, int first, int interval = 1) {
  ErrorEstimate estimate(interval);
  std::pair<double, double> extremes{HUGE_VAL, 0};
  for (int call = 1; squared(modes, call * interval) > 1e-200 && call < 400; ++call) {
    const int k = call * interval;
    const double ratio = estimate(squared(modes, k, true)) / squared(modes, k);
    if (call < first) continue;
    extremes = {std::min(extremes.first, ratio), std::max(extremes.second, ratio)};
  }
  return extremes;
}

constexpr int kHistory = plan::kCircle + plan::kLag;  // changes that an estimate looks at

// The error times the safety. Some changes before the last one count as well.
TEST(ErrorEstimate, OfAGeometricSequenceIsProportionalToItsError) {
  for (const int interval : {1, 10}) {
    for (const double rate : {0.6, 0.9, plan::kLargestRate}) {
      const auto [least, most] = extreme_ratios({{2, rate}}, kHistory, interval);
      EXPECT_NEAR(most / least, 1, 1e-6) << rate;
      EXPECT_GE(least, plan::kSafety * (1 - 1e-6)) << rate;
      EXPECT_LE(most, 1.01 * plan::kSafety * std::pow(rate, -2 * interval * (plan::kCircle - 1)));
    }
  }
}

// As on real meshes: many modes, the slower the weaker. The slowest one remains in the end.
TEST(ErrorEstimate, OfManyModesIsNeverFarBelowTheError) {
  constexpr double kMostBelow = 2.5;
  for (const double slowest : {0.03, 0.06, 0.1}) {
    for (const double decay : {0.7, 0.5, 0.35}) {
      Modes modes;
      double amplitude = 1;
      for (double rate = 0.5; rate > slowest; rate /= 1.3, amplitude *= decay) {
        modes.push_back({amplitude, 1 - rate});
      }
      EXPECT_GT(extreme_ratios(modes, 1).first, 1 / kMostBelow) << slowest << " with " << decay;
    }
  }
}

// One weight of a circle comes and goes, and its changes are small at times.
TEST(ErrorEstimate, SeesThroughWeightsThatCircle) {
  for (const double period : {3.0, 7.0, 12.0, 20.0}) {
    for (const double radius : {0.8, 0.9, 0.95}) {
      const auto factor = std::polar(radius, 2 * 3.14159265358979 / period);
      ErrorEstimate estimate;
      for (int k = 1; k <= 100; ++k) {
        const auto change = std::pow(factor, k - 1) * (factor - 1.0);
        EXPECT_GT(estimate(std::pow(change.real(), 2)), 0.5 * std::pow(radius, 2 * k))
            << period << ", " << radius << " at " << k;
      }
    }
  }
}

// Changes that creep become small for a while, when weights swing.
TEST(ErrorEstimate, IsNotFooledByADipLateInARun) {
  constexpr double kMostBelow = 2.5, kDip = 0.2, kRate = 0.99;
  ErrorEstimate estimate;
  for (int k = 1; k <= 400; ++k) {
    const bool dips = k > 320 && k % 40 < plan::kCircle;
    const double change = std::pow(kRate, k - 1) * (1 - kRate);
    const double ratio = estimate(change * change * (dips ? kDip : 1)) / std::pow(kRate, 2 * k);
    if (k > 320) {
      EXPECT_GT(ratio, 1 / kMostBelow) << k;
    }
  }
}

TEST(ErrorEstimate, OfWeightsThatStayIsZeroAndOthersArePassedOn) {
  ErrorEstimate estimate;
  for (int k = 0; k < 2 * kHistory; ++k) EXPECT_EQ(estimate(0), 0);
  EXPECT_TRUE(std::isnan(estimate(std::nan(""))));
  EXPECT_EQ(estimate(HUGE_VAL), HUGE_VAL);
}

TEST(ErrorEstimate, ForgetsAllChangesWhenItRestarts) {
  ErrorEstimate estimate, other;
  for (int k = 0; k < kHistory; ++k) estimate(1 + k);
  estimate.restart();
  for (int k = 0; k < 2 * kHistory; ++k) EXPECT_EQ(estimate(1.0 / (1 + k)), other(1.0 / (1 + k)));
}

// A step that is not judged at the end of an interval leaves no trace in later estimates.
TEST(StopRuleTest, RelatesStepsToTheTolerance) {
  auto rule = StopRule::estimate(3, 1), other = rule;
  ErrorEstimate estimate;
  for (const double change : {9.0, 4.0, 1.0}) {
    rule.judge({change / 2}, 1, false);
    const double expected = estimate(3 * change) / 5;
    EXPECT_DOUBLE_EQ(rule.judge({change}, 5).primal, expected);
    EXPECT_DOUBLE_EQ(other.judge({change}, 5).primal, expected);
  }
  const auto [primal, dual] = StopRule::residuals(2, 3).judge({7, 11, 13}, 0.5);
  EXPECT_DOUBLE_EQ(primal, 2 * 11 / 0.5);
  EXPECT_DOUBLE_EQ(dual, 3 * 13 / (10 * 0.5));  // section 5 of the paper
}

}  // namespace
}  // namespace flbc
