// SPDX-License-Identifier: BSD-3-Clause
// The estimate that Method::kValue stops by, on errors that are known because they are made up.
#include "solver/run/error_estimate.h"

#include <complex>

#include "support/test.h"

namespace flbc {
namespace {

using Modes = std::vector<std::pair<double, std::complex<double>>>;  // amplitude, factor

// Weights with limit 0 whose error is a sum of modes in directions of their own, each multiplied by
// its factor in every iteration.
struct MadeUpRun {
  Modes modes;

  std::vector<double> weights(int iteration) const {
    std::vector<double> result;
    for (const auto& [amplitude, factor] : modes) {
      const auto part = amplitude * std::pow(factor, iteration);
      result.push_back(part.real());
      result.push_back(part.imag());
    }
    return result;
  }
};

// A weight with limit 0 whose error shrinks as a power of the number of iterations.
struct PowerRun {
  double power;

  std::vector<double> weights(int iteration) const { return {std::pow(1 + iteration, -power)}; }
};

double mean_square(const std::vector<double>& weights) {
  return std::inner_product(weights.begin(), weights.end(), weights.begin(), 0.0) /
         static_cast<double>(weights.size());
}

double mean_squared_difference(std::vector<double> a, const std::vector<double>& b) {
  std::transform(a.begin(), a.end(), b.begin(), a.begin(), std::minus<>());
  return mean_square(a);
}

constexpr double kNever = 0;  // a tolerance that is not reached: no residual is asked for

// An estimate of a run whose tolerance does not change.
class FixedEstimate {
 public:
  FixedEstimate(Origin origin, double tolerance) : estimate_(origin), tolerance_(tolerance) {}
  bool wants_residual() const { return estimate_.wants_residual(); }
  double operator()(int iteration, double change, const std::optional<Movement>& movement,
                    double residual = -1) {
    return estimate_(iteration, tolerance_, change, movement, residual);
  }

 private:
  ErrorEstimate estimate_;
  double tolerance_;
};

// Calls `check(iteration, estimate / error)` whenever there is a fresh estimate.
template <class Run>
void follow(const Run& run, int last, const std::function<void(int, double)>& check) {
  FixedEstimate estimate(Origin::kCold, kNever);
  WeightHistory history({0}, static_cast<Index>(run.weights(0).size()), true);
  for (int k = 0; k <= last; ++k) {
    const auto weights = run.weights(k);
    const auto movement =
        history(k, [&](Index, double* row) { std::copy(weights.begin(), weights.end(), row); });
    if (k == 0) continue;
    const double change = mean_squared_difference(weights, run.weights(k - 1));
    const double now = estimate(k, change, movement);
    if (movement && k >= plan::error_estimate::kFirstMeasured) check(k, now / mean_square(weights));
  }
}

// The promise is a true error of at most twice the tolerance.
constexpr double kLeastOfTrue = 0.5;

TEST(ErrorEstimate, IsTheErrorWhereItShrinksAsAPower) {
  for (const double power : {0.5, 1.0, 2.0, 3.0}) {
    follow(PowerRun{power}, 5000, [&](int k, double ratio) {
      EXPECT_GT(ratio, 1) << power << " at " << k;
      EXPECT_LT(ratio, 2) << power << " at " << k;
    });
  }
}

TEST(ErrorEstimate, IsLargerThanTheErrorOfADrift) {
  for (const double factor : {0.98, 0.985, 0.99}) {
    follow(MadeUpRun{{{0.1, factor}}}, 500,
           [&](int k, double ratio) { EXPECT_GT(ratio, 1) << factor << " at " << k; });
  }
}

TEST(ErrorEstimate, FollowsASlowPartOnceItShows) {
  for (const double slow : {0.995, 0.998, 0.9995}) {
    follow(MadeUpRun{{{1, 0.93}, {0.05, slow}}}, 3000, [&](int k, double ratio) {
      if (k < 250) return;
      EXPECT_GT(ratio, kLeastOfTrue) << slow << " at " << k;
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
      follow(run, 400, [&](int k, double ratio) {
        EXPECT_GT(ratio, 1) << slowest << " with " << decay << " at " << k;
        EXPECT_LT(ratio, 15) << slowest << " with " << decay << " at " << k;
      });
    }
  }
}

TEST(ErrorEstimate, SeesThroughOscillations) {
  for (const double period : {20.0, 40.0, 80.0}) {
    const auto factor = std::polar(0.98, 2 * 3.14159265358979 / period);
    follow(MadeUpRun{{{1, factor}, {0.5, std::conj(factor) * 0.99}, {0.02, 0.985}}}, 400,
           [&](int k, double ratio) { EXPECT_GT(ratio, kLeastOfTrue) << period << " at " << k; });
  }
}

TEST(ErrorEstimate, JudgesByChangesAtFirstMoreCarefullyAfterAWarmStart) {
  FixedEstimate cold(Origin::kCold, kNever);
  FixedEstimate warm(Origin::kNearby, kNever);
  const double estimate = cold(1, 1e-9, {});
  EXPECT_GT(estimate, 1e-7);
  EXPECT_GT(warm(1, 1e-9, {}), estimate);
  EXPECT_LT(cold(2, 1e-10, {}), estimate);
}

TEST(ErrorEstimate, KeepsTheLastEstimateBetweenTwoLooks) {
  FixedEstimate estimate(Origin::kCold, kNever);
  const double last = estimate(40, 1e-11, Movement{26, 32, 40, 1e-6, 5e-7, 1});
  EXPECT_EQ(estimate(41, 1e-15, {}), last);
  EXPECT_LT(estimate(48, 1e-11, Movement{32, 40, 48, 5e-7, 1e-7, 1}), last);
}

TEST(ErrorEstimate, PassesOnNumbersThatAreNotFinite) {
  FixedEstimate estimate(Origin::kCold, kNever);
  EXPECT_TRUE(std::isnan(estimate(1, std::nan(""), {})));
  EXPECT_TRUE(std::isinf(estimate(2, INFINITY, {})));
}

TEST(ErrorEstimate, CatchesRunsThatSpeedUpAgain) {
  FixedEstimate slow(Origin::kCold, kNever);
  FixedEstimate fast(Origin::kCold, kNever);
  const Movement movement{32, 40, 48, 1e-6, 1e-7, 1};
  EXPECT_GT(fast(48, 1e-8, movement), 10 * slow(48, 1e-10, movement));
}

TEST(ErrorEstimate, DoesNotEndWhereNothingShrinks) {
  FixedEstimate estimate(Origin::kCold, kNever);
  EXPECT_GT(estimate(48, 1e-12, Movement{32, 40, 48, 1e-8, 1e-8, 1}), 1e-6);
  EXPECT_GT(estimate(56, 1e-12, Movement{32, 40, 56, 1e-8, 2e-8, 1}), 1e-6);
}

TEST(ErrorEstimate, OfWeightsThatStayIsZero) {
  FixedEstimate estimate(Origin::kCold, kNever);
  EXPECT_EQ(estimate(48, 0, Movement{32, 40, 48, 0, 0, 1}), 0);
}

// ---- what the weights do not show ---------------------------------------------------------------

// Movement that shrinks to a third whenever the number of iterations grows by a quarter.
Movement shrinking(double last) {
  return {64, 80, 100, 3 * last, last, 1};
}

// Brings an estimate to where weights alone would end a run that promises 1e-6.
int bring_to_the_end(FixedEstimate& estimate) {
  EXPECT_FALSE(estimate.wants_residual());
  for (int k = 32;; k += 8) {
    const double now = estimate(k, 1e-12, shrinking(1e-3 * std::pow(0.3, (k - 32) / 8)));
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
  FixedEstimate estimate(Origin::kCold, 1e-6);
  const int k = bring_to_the_end(estimate);
  EXPECT_LE(estimate(k + 1, 1e-12, {}, 1e-7), 1e-6);
  EXPECT_FALSE(estimate.wants_residual());
}

TEST(ErrorEstimate, ALargeResidualKeepsARunGoing) {
  FixedEstimate estimate(Origin::kCold, 1e-6);
  const int k = bring_to_the_end(estimate);
  EXPECT_GT(estimate(k + 1, 1e-12, {}, 1e-3), 1e-5);
  EXPECT_FALSE(estimate.wants_residual());  // not again at once
  int next = k + 2;
  for (; next < 2 * k && !estimate.wants_residual(); ++next) {
    const auto movement = next % 8 == 0 ? std::optional(shrinking(1e-9)) : std::nullopt;
    EXPECT_GT(estimate(next, 1e-12, movement), 1e-5) << next;
  }
  ASSERT_LT(next, 2 * k);
  EXPECT_LE(estimate(next, 1e-12, {}, 1e-7), 1e-6);
}

TEST(ErrorEstimate, AResidualCountsMoreTheLongerItStays) {
  const auto hidden = [](int iterations) {
    FixedEstimate estimate(Origin::kCold, 1e-6);
    return estimate(iterations, 1e-12, shrinking(1e-20), 1e-3);
  };
  EXPECT_GT(hidden(80), 1e-3 / 40);
  EXPECT_GT(hidden(1600), 10 * hidden(80));
}

// Weights of round cages rest near their start before they move on.
TEST(ErrorEstimate, IsNotBelievedBeforeWeightsHaveMoved) {
  const auto after = [](Origin origin, double since_start) {
    FixedEstimate estimate(origin, 1e-6);
    auto movement = shrinking(1e-7);
    movement.since_start = since_start;
    estimate(200, 1e-12, movement);
    return estimate(201, 1e-12, {}, 1e-12);
  };
  EXPECT_LE(after(Origin::kCold, 1e-4), 1e-6);
  EXPECT_GT(after(Origin::kCold, 5e-6), 1e-6);
  EXPECT_LE(after(Origin::kNearby, 5e-6), 1e-6);
}

TEST(ErrorEstimate, PassesOnResidualsThatAreNotFinite) {
  FixedEstimate estimate(Origin::kCold, 1e-6);
  const int last = bring_to_the_end(estimate);
  EXPECT_TRUE(std::isnan(estimate(last + 1, 1e-12, {}, std::nan(""))));
}

// ---- movement of weights ------------------------------------------------------------------------

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

// Weights that move by the same amount in every iteration tell which iterations were compared.
TYPED_TEST(WeightHistoryTest, ComparesTwoIntervalsThatGrowWithTheIterations) {
  constexpr bool kInDouble = std::is_same_v<TypeParam, double>;
  const std::vector<Index> vertices{0, 2, 3};  // vertex 1 is on the boundary
  constexpr std::size_t kStride = 8;
  WeightHistory history(vertices, kStride, kInDouble);
  std::vector<TypeParam> weights(4 * kStride);
  std::vector<double> intervals(801, 0.0);  // by the iteration at which they end
  for (int iteration = 0; iteration <= 800; ++iteration) {
    for (std::size_t v = 0; v < 4; ++v) {
      weights[v * kStride] = static_cast<TypeParam>(iteration * (v + 1));
    }
    weights[kStride] = static_cast<TypeParam>(1e6 * iteration);
    const auto movement = history(iteration, rows_of(weights, kStride));
    const bool compares = iteration % WeightHistory::kStep == 0 && iteration > 8;
    ASSERT_EQ(movement.has_value(), compares) << iteration;
    if (!compares) {
      if (iteration == 8) intervals[8] = 8;  // to the start
      continue;
    }
    const double of_one = (1 + 9 + 16) / 3.0 / kStride;  // of an interval of one iteration
    const double interval = std::sqrt(movement->last / of_one);
    intervals[iteration] = interval;
    const int began = static_cast<int>(std::lround(iteration - interval));
    EXPECT_EQ(movement->middle - movement->from, std::lround(intervals[began])) << iteration;
    EXPECT_NEAR(movement->before, of_one * std::pow(intervals[began], 2), 1e-6) << iteration;
    EXPECT_NEAR(movement->since_start, of_one * std::pow(iteration, 2), 1e-3) << iteration;
    EXPECT_EQ(movement->to, iteration);
    EXPECT_EQ(movement->middle, began);
    EXPECT_LE(began, 0.8 * iteration) << iteration;
    EXPECT_GE(began + 1.2 * WeightHistory::kStep, 0.8 / 1.2 * iteration) << iteration;
  }
}

TYPED_TEST(WeightHistoryTest, ASampleOfALargeMeshServes) {
  constexpr bool kInDouble = std::is_same_v<TypeParam, double>;
  std::vector<Index> vertices(100000);
  std::iota(vertices.begin(), vertices.end(), 0);
  WeightHistory history(vertices, 8, kInDouble);
  std::vector<TypeParam> weights(8 * vertices.size());
  const auto rows = rows_of(weights, 8);
  history(0, rows);
  double sum = 0;
  for (std::size_t v = 0; v < vertices.size(); ++v) {
    weights[8 * v + 3] = static_cast<TypeParam>(std::sin(1e-4 * static_cast<double>(v)));
    sum += std::pow(static_cast<double>(weights[8 * v + 3]), 2);
  }
  history(8, rows);
  const double mean = sum / static_cast<double>(weights.size());
  EXPECT_NEAR(history(16, rows)->before, mean, 0.01 * mean);
}

}  // namespace
}  // namespace flbc
