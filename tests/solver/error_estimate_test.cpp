// SPDX-License-Identifier: BSD-3-Clause
// The estimate that Method::kValue stops by, on errors that are known because they are made up.
#include "solver/run/error_estimate.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <functional>
#include <numeric>
#include <type_traits>

#include <vector>

#include <gtest/gtest.h>

namespace flbc {
namespace {

using Modes = std::vector<std::pair<double, std::complex<double>>>;  // amplitude, factor

// Weights whose error is a sum of modes in directions of their own, each multiplied by its factor
// in every iteration.
struct MadeUpRun {
  Modes modes;

  std::complex<double> part(std::size_t mode, int iteration) const {
    return modes[mode].first * std::pow(modes[mode].second, iteration);
  }
  double error(int iteration) const {
    double sum = 0;
    for (std::size_t m = 0; m < modes.size(); ++m) sum += std::norm(part(m, iteration));
    return sum;
  }
  double difference(int iteration, int before) const {
    double sum = 0;
    for (std::size_t m = 0; m < modes.size(); ++m) {
      sum += std::norm(part(m, iteration) - part(m, before));
    }
    return sum;
  }
};

// Weights whose error shrinks as a power of the number of iterations.
struct PowerRun {
  double power;

  double length(int iteration) const { return std::pow(1 + iteration, -power); }
  double error(int iteration) const { return std::pow(length(iteration), 2); }
  double difference(int iteration, int before) const {
    return std::pow(length(iteration) - length(before), 2);
  }
};

// The same where all weights behave alike. \param difference  negative if unknown
double next_of(ErrorEstimate& estimate, int iteration, double change, double difference,
               double residual = -1) {
  using Differences = std::vector<double>;
  return estimate(iteration, change, difference < 0 ? Differences() : Differences{difference},
                  residual);
}

constexpr double kNever = 0;  // a tolerance that is not reached: no residual is asked for

// Calls `check(iteration, estimate / error, allowed / error)` whenever there is a fresh estimate.
// `allowed` is a bit more than a third of what would be left if the weights approached their limit
// as 1 / k. The estimate assumes so much of every run, and must not be larger without reason.
template <class Run>
void follow(const Run& run, int last, const std::function<void(int, double, double)>& check) {
  constexpr int kSpan = WeightHistory::kSpan;
  ErrorEstimate estimate(Origin::kCold, 3, kNever);
  for (int k = 1; k <= last; ++k) {
    const bool look = k >= kSpan && k % WeightHistory::kStep == 0;
    const double now =
        next_of(estimate, k, run.difference(k, k - 1), look ? run.difference(k, k - kSpan) : -1);
    if (!look || k <= 2 * kSpan) continue;
    const double allowed = 0.36 * std::pow(double(k) / kSpan, 2) * run.difference(k, k - kSpan);
    check(k, now / run.error(k), allowed / run.error(k));
  }
}

TEST(ErrorEstimate, IsTheErrorOfADriftAndALittleMore) {
  for (const double factor : {0.98, 0.985, 0.99}) {
    follow(MadeUpRun{{{0.1, factor}}}, 500, [&](int k, double ratio, double allowed) {
      // Before it has shrunk much, it may as well shrink as a power of k.
      const bool shows = -std::log(factor) * k > 3.2;
      EXPECT_GT(ratio, 1.2) << factor << " at " << k;
      EXPECT_LT(ratio, std::max(allowed, shows ? 1.6 : 12)) << factor << " at " << k;
    });
  }
}

// Powers of the length; the mean squared error shrinks with twice the power.
TEST(ErrorEstimate, IsNotMuchTooSmallWhereErrorsShrinkAsAPower) {
  for (const double power : {0.5, 1.0, 2.0, 3.0}) {
    follow(PowerRun{power}, 5000, [&](int k, double ratio, double allowed) {
      if (k < 250) return;  // a span is too large a part of the iterations
      EXPECT_GT(ratio, power < 1 ? 0.2 : 0.28) << power << " at " << k;
      EXPECT_LT(ratio, std::max(allowed, 3.0)) << power << " at " << k;
    });
  }
}

TEST(ErrorEstimate, FollowsASlowPartOnceItShows) {
  for (const double slow : {0.995, 0.998, 0.9995}) {
    follow(MadeUpRun{{{1, 0.93}, {0.05, slow}}}, 3000, [&](int k, double ratio, double allowed) {
      if (k < 250) return;
      // It shrinks to a third within 1 / rate iterations; farther than one and a half times the
      // iterations there have been is not looked.
      const double seen = std::min(1.0, std::pow(-1.5 * k * std::log(slow), 2));
      EXPECT_GT(ratio, 0.9 * seen) << slow << " at " << k;
      EXPECT_LT(ratio, std::max(allowed, 10.0)) << slow << " at " << k;
    });
  }
}

// As on real meshes: many modes, the slower the weaker, of which slow ones remain in the end. (What
// a single slow mode far from all others will do, nothing tells before it shows.)
TEST(ErrorEstimate, IsNotMuchTooSmallWhereSlowPartsRemain) {
  for (const double slowest : {0.02, 0.015, 0.01}) {
    for (const double decay : {0.7, 0.5, 0.35}) {
      MadeUpRun run;
      double amplitude = 1;
      for (double rate = 0.1; rate > slowest; rate /= 1.3, amplitude *= decay) {
        run.modes.push_back({amplitude, std::exp(-rate)});
      }
      follow(run, 400, [&](int k, double ratio, double allowed) {
        EXPECT_GT(ratio, 1.0 / 3) << slowest << " with " << decay << " at " << k;
        // While the error shrinks to nothing within a span, the difference is the error before.
        EXPECT_LT(ratio, std::max(allowed, k < 100 ? 40.0 : 10.0))
            << slowest << " with " << decay << " at " << k;
      });
    }
  }
}

TEST(ErrorEstimate, SeesThroughOscillations) {
  for (const double period : {20.0, 40.0, 80.0}) {
    const auto factor = std::polar(0.98, 2 * 3.14159265358979 / period);
    follow(MadeUpRun{{{1, factor}, {0.5, std::conj(factor) * 0.99}, {0.02, 0.985}}}, 400,
           [&](int k, double ratio, double allowed) {
             EXPECT_GT(ratio, 1.0 / 3) << period << " at " << k;
             // Early changes count as if the error shrank as a power, of which nothing oscillates.
             EXPECT_LT(ratio, std::max(allowed, k <= 104 ? 500.0 : 50.0)) << period << " at " << k;
           });
  }
}

TEST(ErrorEstimate, JudgesByChangesAtFirstMoreCarefullyAfterAWarmStart) {
  ErrorEstimate cold(Origin::kCold, 3, kNever);
  ErrorEstimate warm(Origin::kNearby, 3, kNever);
  const double estimate = next_of(cold, 1, 1e-9, -1);
  EXPECT_GT(estimate, 1e-7);
  EXPECT_GT(next_of(warm, 1, 1e-9, -1), estimate);
  EXPECT_LT(next_of(cold, 2, 1e-10, -1), estimate);
}

// Errors that shrink as a power of k are k^2 / power^2 times the squared change. What rates show of
// them early is less, in 3D as in the models.
TEST(ErrorEstimate, OfEarlyIterationsIsNoLessThanAPowerTells) {
  for (const auto start : {Origin::kCold, Origin::kCoarserMesh}) {
    for (const double power : {1.0, 1.5}) {
      const PowerRun run{power};
      ErrorEstimate estimate(start, 3, kNever);
      for (int k = 1; k <= 104; ++k) {
        const bool look = k >= 32 && k % 8 == 0;
        const double change = run.difference(k, k - 1);
        const double now = next_of(estimate, k, change, look ? run.difference(k, k - 32) : -1);
        if (!look) continue;
        EXPECT_GE(now, 0.399 * k * k * change) << power << " at " << k;
        EXPECT_GE(now, 0.3 * power * power * run.error(k)) << power << " at " << k;
      }
    }
  }
}

TEST(ErrorEstimate, KeepsTheLastEstimateBetweenTwoLooks) {
  ErrorEstimate estimate(Origin::kCold, 3, kNever);
  next_of(estimate, 32, 1e-11, 1e-6);
  const double last = next_of(estimate, 40, 1e-11, 5e-7);
  EXPECT_EQ(next_of(estimate, 41, 1e-15, -1), last);
  EXPECT_LT(next_of(estimate, 48, 1e-11, 1e-7), last);
}

// Weights of one control point creep in a slit, while those of 19 others settle.
TEST(ErrorEstimate, SeesAControlPointThatCreeps) {
  const MadeUpRun fast{{{1, 0.9}}}, slow{{{0.01, 0.998}}};
  // Not from a cold start, which assumes that all weights creep.
  ErrorEstimate of_each(Origin::kNearby, 2, kNever), of_all(Origin::kNearby, 2, kNever);
  for (int k = 32; k <= 120; k += 8) {
    std::vector<double> differences(20, fast.difference(k, k - 32));
    differences[7] = slow.difference(k, k - 32);
    double sum = 0;
    for (const double difference : differences) sum += difference;
    const double error = (19 * fast.error(k) + slow.error(k)) / 20;
    const double each = of_each(k, 0, differences);
    const double all = of_all(k, 0, {sum / 20});
    EXPECT_GT(each, 0.05 * error) << k;
    // The mean of all differences would miss it.
    if (k >= 112) {
      EXPECT_LT(all, 0.01 * error) << k;
    }
  }
}

TEST(ErrorEstimate, PassesOnNumbersThatAreNotFinite) {
  ErrorEstimate estimate(Origin::kCold, 3, kNever);
  EXPECT_TRUE(std::isnan(next_of(estimate, 1, std::nan(""), -1)));
  EXPECT_TRUE(std::isinf(next_of(estimate, 2, INFINITY, -1)));
}

TEST(ErrorEstimate, CatchesRunsThatSpeedUpAgain) {
  ErrorEstimate slow(Origin::kCold, 3, kNever);
  ErrorEstimate fast(Origin::kCold, 3, kNever);
  for (const auto estimate : {&slow, &fast}) {
    next_of(*estimate, 32, 1e-9, 1e-5);
    next_of(*estimate, 40, 1e-9, 1e-6);
  }
  EXPECT_GT(next_of(fast, 48, 1e-8, 1e-7), 10 * next_of(slow, 48, 1e-10, 1e-7));
}

TEST(ErrorEstimate, DoesNotEndWhereNothingShrinks) {
  ErrorEstimate estimate(Origin::kCold, 3, kNever);
  for (int k = 32; k < 400; k += 8) {
    EXPECT_GT(next_of(estimate, k, 1e-12, 1e-8), k > 40 ? 1e-7 : 1e-9);
  }
}

// ---- what the weights do not show ---------------------------------------------------------------

// Brings an estimate to where weights alone would end a run that promises 1e-6.
int bring_to_the_end(ErrorEstimate& estimate) {
  EXPECT_FALSE(estimate.wants_residual());
  for (int k = 32;; k += 8) {
    const double now = next_of(estimate, k, 1e-12, 1e-3 * std::pow(0.3, (k - 32) / 8));
    if (estimate.wants_residual()) {
      EXPECT_GT(now, 1e-6);
      return k;
    }
    if (now <= 1e-6 || k > 1000) {
      ADD_FAILURE() << "ends unconfirmed at " << k;
      return k;
    }
  }
}

TEST(ErrorEstimate, IsConfirmedByASmallResidual) {
  ErrorEstimate estimate(Origin::kCold, 3, 1e-6);
  const int k = bring_to_the_end(estimate);
  EXPECT_LE(next_of(estimate, k + 1, 1e-12, -1, 1e-7), 1e-6);
  EXPECT_FALSE(estimate.wants_residual());
}

TEST(ErrorEstimate, ALargeResidualKeepsARunGoing) {
  ErrorEstimate estimate(Origin::kCold, 3, 1e-6);
  const int k = bring_to_the_end(estimate);
  EXPECT_GT(next_of(estimate, k + 1, 1e-12, -1, 1e-3), 1e-5);
  EXPECT_FALSE(estimate.wants_residual());  // not again at once
  int next = k + 2;
  for (; next < 2 * k && !estimate.wants_residual(); ++next) {
    EXPECT_GT(next_of(estimate, next, 1e-12, next % 8 == 0 ? 1e-9 : -1), 1e-5) << next;
  }
  ASSERT_LT(next, 2 * k);
  EXPECT_LE(next_of(estimate, next, 1e-12, -1, 1e-7), 1e-6);
}

TEST(ErrorEstimate, AResidualCountsMoreTheLongerItStays) {
  const auto hidden = [](int iterations) {
    ErrorEstimate estimate(Origin::kCold, 3, 1e-6);
    int k = 40;
    for (; k < iterations; k += 8) next_of(estimate, k, 1e-12, 1e-3 * std::pow(0.9, k));
    return next_of(estimate, k, 1e-12, 1e-20, 1e-3);
  };
  EXPECT_GT(hidden(80), 1e-3 / 40);
  EXPECT_GT(hidden(1600), 10 * hidden(80));
}

TEST(ErrorEstimate, PassesOnResidualsThatAreNotFinite) {
  ErrorEstimate estimate(Origin::kCold, 3, 1e-6);
  const int last = bring_to_the_end(estimate);
  EXPECT_TRUE(std::isnan(next_of(estimate, last + 1, 1e-12, -1, std::nan(""))));
}

// ---- differences of weights ---------------------------------------------------------------------

template <class Scalar>
class WeightHistoryTest : public ::testing::Test {};
using Scalars = ::testing::Types<float, double>;
TYPED_TEST_SUITE(WeightHistoryTest, Scalars);

template <class Scalar>
WeightHistory::ReadRow rows_of(const std::vector<Scalar>& weights, std::size_t stride) {
  return [&weights, stride](Index vertex, double* row) {
    std::copy_n(weights.data() + vertex * stride, stride, row);
  };
}

TYPED_TEST(WeightHistoryTest, ComparesWithTheWeightsASpanAgo) {
  using History = WeightHistory;
  constexpr bool kInDouble = std::is_same_v<TypeParam, double>;
  const std::vector<Index> vertices{0, 2, 3};  // vertex 1 is on the boundary
  constexpr std::size_t kStride = 8;
  History history(vertices, kStride, kInDouble);
  std::vector<TypeParam> weights(4 * kStride);
  for (int iteration = 0; iteration <= 200; ++iteration) {
    for (std::size_t v = 0; v < 4; ++v) {
      weights[v * kStride] = static_cast<TypeParam>(iteration * (v + 1));
    }
    weights[kStride] = static_cast<TypeParam>(1e6 * iteration);
    const auto differences = history(iteration, rows_of(weights, kStride));
    if (iteration % History::kStep != 0 || iteration < History::kSpan) {
      EXPECT_TRUE(differences.empty()) << iteration;
    } else {
      ASSERT_EQ(differences.size(), kStride);
      EXPECT_DOUBLE_EQ(differences[0], History::kSpan * History::kSpan * (1 + 9 + 16) / 3.0);
      EXPECT_EQ(differences[1], 0);
    }
  }
}

TYPED_TEST(WeightHistoryTest, ASampleOfALargeMeshServes) {
  using History = WeightHistory;
  constexpr bool kInDouble = std::is_same_v<TypeParam, double>;
  std::vector<Index> vertices(100000);
  std::iota(vertices.begin(), vertices.end(), 0);
  History history(vertices, 8, kInDouble);
  std::vector<TypeParam> weights(8 * vertices.size());
  const auto rows = rows_of(weights, 8);
  history(0, rows);
  double sum = 0;
  for (std::size_t v = 0; v < vertices.size(); ++v) {
    weights[8 * v + 3] = static_cast<TypeParam>(std::sin(1e-4 * static_cast<double>(v)));
    sum += std::pow(static_cast<double>(weights[8 * v + 3]), 2);
  }
  EXPECT_NEAR(history(History::kSpan, rows)[3], sum / 1e5, 0.01 * sum / 1e5);
}

}  // namespace
}  // namespace flbc
