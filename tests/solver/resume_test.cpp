// SPDX-License-Identifier: BSD-3-Clause
// A run that stops at any check and goes on from its state is the run that never stopped, to the
// bit.
#include <algorithm>
#include <sstream>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "flbc/editing.h"
#include "flbc/errors.h"
#include "flbc/solver.h"
#include "support/coarse_sample_mesher.h"
#include "support/sample_meshes.h"

namespace flbc::testing {
namespace {

template <class Dimension>
class ResumeTest : public ::testing::Test {};
using Dimensions = ::testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(ResumeTest, Dimensions);

struct State {
  int iteration;
  std::string bytes;
};

// Keeps the states that are offered.
template <int Dim>
Solution solve_and_keep(const Sample<Dim>& sample, SolverOptions options,
                        const CoarseMesher<Dim>& mesher, std::vector<State>& states) {
  options.progress = [&](const Progress& progress) {
    if (!progress.write_state) return true;
    std::ostringstream out;
    progress.write_state(out);
    states.push_back({progress.iteration, out.str()});
    return true;
  };
  return solve(sample.cage, sample.mesh, options, mesher);
}

bool same_bits(const WeightMatrix& a, const WeightMatrix& b) {
  return a.rows() == b.rows() && a.cols() == b.cols() && (a.array() == b.array()).all();
}

void expect_same(const Solution& resumed, const Solution& whole) {
  EXPECT_TRUE(same_bits(resumed.weights, whole.weights));
  const auto &a = resumed.report, &b = whole.report;
  EXPECT_EQ(a.iterations, b.iterations);
  EXPECT_EQ(a.status, b.status);
  EXPECT_EQ(a.criterion, b.criterion);
  EXPECT_EQ(a.primal_residual, b.primal_residual);
  EXPECT_EQ(a.dual_residual, b.dual_residual);
  EXPECT_EQ(a.penalty, b.penalty);
  EXPECT_EQ(a.objective, b.objective);
  EXPECT_EQ(a.certificate.relative_gap, b.certificate.relative_gap);
  EXPECT_EQ(a.state_scalars_per_cell, b.state_scalars_per_cell);
  EXPECT_EQ(a.active_pairs.density, b.active_pairs.density);
  EXPECT_EQ(a.active_pairs.growths, b.active_pairs.growths);
  EXPECT_EQ(a.distances.source, b.distances.source);
  EXPECT_EQ(a.distances.phi_error, b.distances.phi_error);
  ASSERT_EQ(a.coarse_levels.size(), b.coarse_levels.size());
  for (std::size_t k = 0; k < a.coarse_levels.size(); ++k) {
    EXPECT_EQ(a.coarse_levels[k].iterations, b.coarse_levels[k].iterations);
  }
}

// Goes on from the first state, the last and some between; and once more from one that such a run
// has left.
//! \return the run that never stopped
template <int Dim>
SolveReport expect_resumable(const Sample<Dim>& sample, const SolverOptions& options,
                             const CoarseMesher<Dim>& mesher = {}) {
  std::vector<State> states;
  const auto whole = solve_and_keep(sample, options, mesher, states);
  EXPECT_GE(states.size(), 3U);
  if (states.size() < 3) return whole.report;
  for (const std::size_t k :
       {std::size_t{0}, std::size_t{1}, states.size() / 2, states.size() - 2, states.size() - 1}) {
    SCOPED_TRACE("from iteration " + std::to_string(states[k].iteration));
    auto going_on = options;
    going_on.resume_from = states[k].bytes;
    std::vector<State> later;
    expect_same(solve_and_keep(sample, going_on, mesher, later), whole);
    EXPECT_EQ(later.size(), states.size() - k - 1);
    if (later.empty()) continue;
    going_on.resume_from = later.front().bytes;
    expect_same(solve(sample.cage, sample.mesh, going_on, mesher), whole);
  }
  return whole.report;
}

TYPED_TEST(ResumeTest, EveryMethodGoesOnToTheSameBits) {
  const auto sample = make_sample<TypeParam::value>(Shape::kCorner, 4, 0.2);
  for (const auto method : {Method::kValue, Method::kGradient, Method::kPaper, Method::kLbc2014}) {
    for (const auto precision : {Precision::kSingle, Precision::kDouble}) {
      SCOPED_TRACE(static_cast<int>(method));
      SolverOptions options;
      options.method = method;
      options.precision = precision;
      options.max_iterations = 700;
      expect_resumable(sample, options);
    }
  }
}

// States from before, between and after the iterations at which the penalty is balanced.
TYPED_TEST(ResumeTest, BalancedPenaltyGoesOn) {
  const auto sample = make_sample<TypeParam::value>(Shape::kStar, 4, 0.2);
  for (const auto non_negative : {NonNegative::kConstraint, NonNegative::kOff}) {
    SolverOptions options;
    options.method = Method::kValue;
    options.non_negative = non_negative;
    options.check_interval = 3;
    options.max_iterations = 45;
    options.tolerance = 1e-12;
    expect_resumable(sample, options);
  }
}

// On enough cells for half precision, which ends with the tolerance or on the way to it.
TYPED_TEST(ResumeTest, HalfPrecisionGoesOn) {
  constexpr int kDim = TypeParam::value;
  const auto sample = make_sample<kDim>(Shape::kBox, kDim == 2 ? 72 : 12, 0.2);
  ASSERT_GE(sample.mesh.num_cells(), 10000);
  double numbers[2] = {};
  for (const double tolerance : {1e-5, 1e-8}) {
    SolverOptions options;
    options.method = Method::kValue;
    options.precision = Precision::kHalf;
    options.tolerance = tolerance;
    options.gap = 0;
    options.check_interval = 5;
    options.max_iterations = 200;
    numbers[tolerance < 1e-6] = expect_resumable(sample, options).state_scalars_per_cell;
  }
  EXPECT_LT(numbers[0], numbers[1]);  // the second run has left half precision
}

TYPED_TEST(ResumeTest, StartFromCoarserMeshesIsNotRepeated) {
  constexpr int kDim = TypeParam::value;
  const auto sample = make_sample<kDim>(Shape::kCorner, 6, 0.2);
  int meshed = 0;
  const CoarseMesher<kDim> mesher = [&](const Cage<kDim>& cage, Index vertices) {
    ++meshed;
    return coarse_sample_mesher<kDim>(3)(cage, vertices);
  };
  SolverOptions options;
  options.method = Method::kValue;
  options.coarse_to_fine = CoarseToFine::kOn;
  options.coarse_levels.coarsest = 10;
  options.tolerance = 1e-9;
  options.gap = 0;
  std::vector<State> states;
  const auto whole = solve_and_keep(sample, options, mesher, states);
  ASSERT_FALSE(whole.report.coarse_levels.empty());
  ASSERT_FALSE(states.empty());
  const int before = meshed;
  options.resume_from = states.front().bytes;
  expect_same(solve(sample.cage, sample.mesh, options, mesher), whole);
  EXPECT_EQ(meshed, before);
  options.resume_from = {};
  expect_resumable(sample, options, mesher);
}

// States from before, at and after the iterations at which the penalty is balanced and the ends of
// supports are looked at; from harmonic coordinates and from a coarser mesh.
TYPED_TEST(ResumeTest, SupportsGoOn) {
  constexpr int kDim = TypeParam::value;
  const auto sample = make_sample<kDim>(Shape::kCorner, kDim == 2 ? 14 : 5, 0.2);
  for (const auto precision : {Precision::kSingle, Precision::kDouble}) {
    for (const auto& mesher :
         {CoarseMesher<kDim>{}, coarse_sample_mesher<kDim>(kDim == 2 ? 5 : 2)}) {
      SCOPED_TRACE(mesher ? "coarse start" : "cold start");
      SolverOptions options;
      options.precision = precision;
      options.active_pairs = ActivePairs::kOn;
      options.coarse_to_fine = mesher ? CoarseToFine::kOn : CoarseToFine::kOff;
      options.coarse_levels.coarsest = 5;
      options.tolerance = 1e-7;
      options.gap = 0;
      options.check_interval = 5;
      const auto report = expect_resumable(sample, options, mesher);
      EXPECT_LT(report.active_pairs.density, 1);
      EXPECT_EQ(report.coarse_levels.size(), mesher ? 1U : 0U);
      EXPECT_GT(report.iterations, 40);
    }
  }
}

// What the supports do not end, all pairs do: so that the gap is known, or because one was asked for.
TYPED_TEST(ResumeTest, SupportsGoOnToAllPairs) {
  constexpr int kDim = TypeParam::value;
  const auto sample = make_sample<kDim>(Shape::kCorner, kDim == 2 ? 14 : 5, 0.2);
  SolverOptions options;
  options.active_pairs = ActivePairs::kOn;
  options.tolerance = 1e-6;
  options.certify = true;
  options.check_interval = 20;
  EXPECT_GT(expect_resumable(sample, options).certificate.lower_bound, 0);
}

TYPED_TEST(ResumeTest, HalfPrecisionOnSupportsGoesOn) {
  constexpr int kDim = TypeParam::value;
  const auto sample = make_sample<kDim>(Shape::kBox, kDim == 2 ? 72 : 12, 0.2);
  ASSERT_GE(sample.mesh.num_cells(), 10000);
  SolverOptions options;
  options.active_pairs = ActivePairs::kOn;
  options.precision = Precision::kHalf;
  options.tolerance = 1e-7;
  options.gap = 0;
  options.check_interval = 20;
  options.max_iterations = 400;
  expect_resumable(sample, options);
}

// Wherever a byte of the supports is another: refused, or lists on which weights still exist.
TYPED_TEST(ResumeTest, DamagedSupportsAreRefusedOrLeaveWeights) {
  constexpr int kDim = TypeParam::value;
  const auto sample = make_sample<kDim>(Shape::kCorner, 3, 0.2);
  SolverOptions options;
  options.active_pairs = ActivePairs::kOn;
  options.max_iterations = 60;
  options.tolerance = 1e-12;
  options.gap = 0;
  options.check_interval = 55;
  std::vector<State> states;
  solve_and_keep(sample, options, {}, states);
  ASSERT_FALSE(states.empty());
  const auto& whole = states.front().bytes;
  int refused = 0;
  for (std::size_t at = 0; at < whole.size(); at += 1 + whole.size() / 400) {
    auto damaged = whole;
    damaged[at] = static_cast<char>(damaged[at] ^ 0x41);
    options.resume_from = damaged;
    try {
      const auto solution = solve(sample.cage, sample.mesh, options);
      EXPECT_TRUE(solution.weights.allFinite()) << at;
    } catch (const Error&) {
      ++refused;
    }
  }
  EXPECT_GT(refused, 0);
}

TYPED_TEST(ResumeTest, LimitAndThreadsMayChange) {
  const auto sample = make_sample<TypeParam::value>(Shape::kCorner, 4, 0.2);
  SolverOptions options;
  options.tolerance = 1e-9;
  const auto whole = solve(sample.cage, sample.mesh, options);
  auto limited = options;
  limited.max_iterations = 64;
  std::vector<State> states;
  ASSERT_EQ(solve_and_keep(sample, limited, {}, states).report.status,
            SolveStatus::kIterationLimit);
  options.threads = 3;
  options.resume_from = states.back().bytes;
  expect_same(solve(sample.cage, sample.mesh, options), whole);
}

TYPED_TEST(ResumeTest, StateOfAnotherRunIsRefused) {
  constexpr int kDim = TypeParam::value;
  const auto sample = make_sample<kDim>(Shape::kCorner, 4, 0.2);
  SolverOptions options;
  std::vector<State> states;
  solve_and_keep(sample, options, {}, states);
  options.resume_from = states.front().bytes;
  const auto refuses = [](const Sample<kDim>& other, const SolverOptions& changed) {
    EXPECT_THROW(solve(other.cage, other.mesh, changed), InputError);
  };
  auto changed = options;
  changed.tolerance = 1e-8;
  refuses(sample, changed);
  changed = options;
  changed.method = Method::kGradient;
  refuses(sample, changed);
  changed = options;
  changed.phi = DistanceScheme::kLinear;
  refuses(sample, changed);
  refuses(make_sample<kDim>(Shape::kCorner, 5, 0.2), options);
  auto moved = sample;
  moved.mesh.points.col(moved.mesh.num_vertices() - 1) *= 1 + 1e-15;
  moved.cage.points *= 1 + 1e-15;
  refuses(moved, options);
}

TYPED_TEST(ResumeTest, StateThatEndsEarlyIsRefused) {
  const auto sample = make_sample<TypeParam::value>(Shape::kCorner, 4, 0.2);
  std::vector<State> states;
  SolverOptions options;
  solve_and_keep(sample, options, {}, states);
  const auto& whole = states.front().bytes;
  for (std::size_t size = 1; size < whole.size(); size += 1 + whole.size() / 50) {
    const std::string part = whole.substr(0, size);
    options.resume_from = part;
    EXPECT_THROW(solve(sample.cage, sample.mesh, options), InputError) << size;
  }
  const std::string longer = whole + "x";
  options.resume_from = longer;
  EXPECT_THROW(solve(sample.cage, sample.mesh, options), InputError);
}

// Wherever the state has the number of iterations. No other number of it is -5 then.
TYPED_TEST(ResumeTest, StateWithANegativeNumberOfIterationsIsRefused) {
  const auto sample = make_sample<TypeParam::value>(Shape::kCorner, 4, 0.2);
  for (const auto method : {Method::kValue, Method::kGradient, Method::kPaper, Method::kLbc2014}) {
    SCOPED_TRACE(static_cast<int>(method));
    std::vector<State> states;
    SolverOptions options;
    options.method = method;
    options.max_iterations = 700;
    solve_and_keep(sample, options, {}, states);
    const auto& [iteration, whole] = states[states.size() / 2];
    const std::string number(reinterpret_cast<const char*>(&iteration), sizeof iteration);
    const int negative = -5;
    int refused = 0;
    for (auto at = whole.find(number); at != whole.npos; at = whole.find(number, at + 1)) {
      auto damaged = whole;
      damaged.replace(at, sizeof negative, reinterpret_cast<const char*>(&negative),
                      sizeof negative);
      options.resume_from = damaged;
      try {
        solve(sample.cage, sample.mesh, options);
      } catch (const InputError& error) {
        refused += std::string(error.what()).find("-5 iterations") != std::string::npos;
      }
    }
    EXPECT_EQ(refused, 1);
  }
}

TYPED_TEST(ResumeTest, WhoeverElseSolvesRefusesAndOffersNothing) {
  constexpr int kDim = TypeParam::value;
  const auto sample = make_sample<kDim>(Shape::kCorner, 4, 0.2);
  const auto problem = make_problem(sample.cage, sample.mesh, DistanceScheme::kSquare);
  SolverOptions options;
  int told = 0;
  options.progress = [&](const Progress& progress) {
    ++told;
    EXPECT_FALSE(progress.write_state);
    return true;
  };
  solve(problem, options);
  LbcSolver<kDim>(sample.cage, sample.mesh, options).solve();
  EXPECT_GT(told, 0);
  options.resume_from = "state";
  EXPECT_THROW(solve(problem, options), OptionError);
  EXPECT_THROW(LbcSolver<kDim>(sample.cage, sample.mesh, options), OptionError);
  EXPECT_THROW(EditableCoordinates<kDim>(sample.cage, sample.mesh, options), OptionError);
}

}  // namespace
}  // namespace flbc::testing
