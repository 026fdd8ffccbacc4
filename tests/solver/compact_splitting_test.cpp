// SPDX-License-Identifier: BSD-3-Clause
// The compact form of the splitting on the weights against the textbook solver of problem (2),
// iterate by iterate, and what it must keep beyond that.
#include "solver/splitting/compact_splitting.h"

#include <cmath>
#include <type_traits>
#include <utility>

#include <gtest/gtest.h>

#include "base/parallel.h"
#include "flbc/harmonic.h"
#include "flbc/quality.h"
#include "flbc/solver.h"
#include "solver/state_storage.h"
#include "support/fine_cages.h"
#include "support/judge.h"
#include "support/sample_meshes.h"
#include "support/simplex.h"
#include "support/splitting_cases.h"

namespace flbc::testing {
namespace {

using compact::CompactSplitting;
using compact::Half;

template <class Dimension>
class CompactSplittingTest : public ::testing::Test {};
using Dimensions = ::testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(CompactSplittingTest, Dimensions);

template <int Dim>
struct Case {
  LbcProblem<Dim> problem;
  splitting::Metric metric;
  double penalty;
};

// Control points for several of the slices in which duals of cells are stored.
template <int Dim>
Sample<Dim> with_many_control_points(Index cage_subdivisions, Index subdivisions) {
  auto sample = with_fine_cage<Dim>(Shape::kCorner, cage_subdivisions, subdivisions);
  sample.name = "fine cage";
  return sample;
}

template <int Dim>
Case<Dim> make_case(const Sample<Dim>& sample, bool non_negative = true) {
  auto problem = make_problem(sample.cage, sample.mesh, DistanceScheme::kSquare);
  auto metric = make_metric(problem, 1, non_negative);
  const double penalty = make_penalty(problem, metric);
  return {std::move(problem), std::move(metric), penalty};
}

template <int Dim>
Case<Dim> make_case(Shape shape, bool non_negative = true) {
  return make_case(make_sample<Dim>(shape, 4, 0.2), non_negative);
}

template <class Splitting>
void iterate(Splitting& splitting, int count) {
  for (int k = 0; k < count; ++k) splitting.iterate();
}

TYPED_TEST(CompactSplittingTest, EqualsTheTextbookIterateByIterate) {
  constexpr int kDim = TypeParam::value;
  auto all = samples<kDim>();
  all.push_back(kDim == 2 ? with_many_control_points<kDim>(7, 14)
                          : with_many_control_points<kDim>(2, 4));
  for (const auto& sample : all) {
    for (const bool non_negative : {false, true}) {
      const double power = non_negative ? 1 : 2;
      SCOPED_TRACE(sample.name + ", metric A^" + std::to_string(power));
      const auto problem = make_problem(sample.cage, sample.mesh, DistanceScheme::kSquare);
      const auto metric = make_metric(problem, power, non_negative);
      const double penalty = make_penalty(problem, metric);
      const double relaxation = non_negative ? 1.65 : 1;
      const auto start = harmonic_coordinates(problem);
      auto textbook = textbook_for(problem, metric, penalty, relaxation, start);
      CompactSplitting<double, double, kDim> splitting(problem, metric, penalty, relaxation);
      splitting.start_from_weights(start);
      for (int iteration = 1; iteration <= 15; ++iteration) {
        const auto before = textbook.weights();
        textbook.iterate();
        const double change =
            iteration % 2 == 0 ? splitting.iterate().change : splitting.iterate_measured().change;
        ASSERT_LT((splitting.weights() - textbook.weights()).cwiseAbs().maxCoeff(), 1e-10)
            << "iteration " << iteration;
        const double expected = (textbook.weights() - before).squaredNorm();
        EXPECT_NEAR(change, expected, 1e-6 * expected + 1e-14);
      }
      // Not by standing still; but a simplex leaves nothing to choose.
      if (sample.cage.size() == kDim + 1) continue;
      EXPECT_GT((splitting.weights() - start).cwiseAbs().maxCoeff(), 1e-3);
    }
  }
}

// The same limit, by every set of loops this processor can run.
template <class Scalar, class Stored, int Dim>
void expect_to_follow(const Case<Dim>& c, const WeightMatrix& exact, double tolerance) {
  const auto list = supported_kernels<compact::Kernel<Scalar, Stored, Dim>>();
  for (int k = 0; k < list.size; ++k) {
    CompactSplitting<Scalar, Stored, Dim> splitting(
        c.problem, c.metric, c.penalty, 1.9, LinearSolver::kDirect, nullptr, *list.kernels[k]);
    splitting.start_from_harmonic(8);
    iterate(splitting, 400);
    EXPECT_LT(squared_error(c.problem, splitting.weights(), exact), tolerance) << "kernel " << k;
  }
}

TYPED_TEST(CompactSplittingTest, LowerPrecisionsFollowDouble) {
  constexpr int kDim = TypeParam::value;
  const auto c = make_case<kDim>(Shape::kCorner);
  CompactSplitting<double, double, kDim> exact(c.problem, c.metric, c.penalty, 1.9);
  exact.start_from_harmonic(8);
  iterate(exact, 400);
  expect_to_follow<double, double>(c, exact.weights(), 1e-20);
  expect_to_follow<float, float>(c, exact.weights(), 1e-10);
  // Radii and duals are rounded by 2^-12 of themselves at most, and weights follow.
  expect_to_follow<float, Half>(c, exact.weights(), std::pow(2.0, -24));
}

template <class Scalar, class Stored, int Dim>
WeightMatrix weights_with_threads(const Case<Dim>& c, int count) {
  const ThreadScope threads(count);
  CompactSplitting<Scalar, Stored, Dim> splitting(c.problem, c.metric, c.penalty, 1.9);
  splitting.start_from_harmonic(8);
  iterate(splitting, 5);
  splitting.iterate_and_adapt(0.3);
  iterate(splitting, 6);
  splitting.iterate_measured();
  return splitting.weights();
}

TYPED_TEST(CompactSplittingTest, IsTheSameForAnyNumberOfThreads) {
  constexpr int kDim = TypeParam::value;
  const auto c = make_case<kDim>(Shape::kCorner);
  const auto single = weights_with_threads<float, float>(c, 1);
  const auto half = weights_with_threads<float, Half>(c, 1);
  for (const int count : {2, 4, 7}) {
    EXPECT_EQ((weights_with_threads<float, float>(c, count) - single).cwiseAbs().maxCoeff(), 0);
    EXPECT_EQ((weights_with_threads<float, Half>(c, count) - half).cwiseAbs().maxCoeff(), 0);
  }
}

// The rows of a storage are whole, other arrays of cells come in slices, one a thread.
template <class Scalar, class Stored, int Dim>
void expect_rows_and_slices_alike(const Case<Dim>& c) {
  const auto run = [&](StateStorage* storage, int threads, WeightMatrix& flux) {
    const ThreadScope scope(threads);
    CompactSplitting<Scalar, Stored, Dim> splitting(c.problem, c.metric, c.penalty, 1.9,
                                                    LinearSolver::kDirect, storage);
    splitting.start_from_harmonic(8);
    iterate(splitting, 5);
    splitting.iterate_and_adapt(0.3);
    splitting.iterate_measured();
    iterate(splitting, 6);
    flux = splitting.flux_density(0);
    for (Index s = 1; s < c.problem.mesh.num_cells(); ++s) flux += splitting.flux_density(s);
    return splitting.weights();
  };
  KeptState rows;
  WeightMatrix flux, flux_of_slices;
  const auto expected = run(&rows, 1, flux);
  EXPECT_GT(flux.norm(), 0);
  for (const int threads : {1, 2, 3, 5}) {
    EXPECT_EQ((run(nullptr, threads, flux_of_slices) - expected).cwiseAbs().maxCoeff(), 0);
    EXPECT_EQ((flux_of_slices - flux).cwiseAbs().maxCoeff(), 0);
  }
}

TYPED_TEST(CompactSplittingTest, SlicesOfControlPointsChangeNoBit) {
  constexpr int kDim = TypeParam::value;
  for (const Index cage_subdivisions : {kDim == 2 ? 7 : 2, kDim == 2 ? 25 : 5}) {
    const auto c = make_case(with_many_control_points<kDim>(cage_subdivisions, cage_subdivisions));
    SCOPED_TRACE(c.problem.num_control_points());
    ASSERT_GT(c.problem.num_control_points(), 32);
    expect_rows_and_slices_alike<float, Half>(c);
    expect_rows_and_slices_alike<float, float>(c);
    expect_rows_and_slices_alike<double, double>(c);
  }
}

// Whatever the penalty is changed to on the way, the duals survive and the optimum stays.
TYPED_TEST(CompactSplittingTest, AdaptingThePenaltyKeepsTheDuals) {
  constexpr int kDim = TypeParam::value;
  const auto c = make_case<kDim>(Shape::kRing);
  CompactSplitting<double, double, kDim> splitting(c.problem, c.metric, c.penalty, 1.5);
  splitting.start_from_harmonic(8);
  iterate(splitting, 3000);
  const double penalty = splitting.penalty();
  const double last = splitting.iterate_and_adapt(0.01).change;
  EXPECT_LT(last, 1e-9);
  const auto before = splitting.weights();
  EXPECT_GT(std::abs(std::log(splitting.penalty() / penalty)), 1);
  double change = 0;
  for (int iteration = 0; iteration < 10; ++iteration) change += splitting.iterate().change;
  EXPECT_LT(change, 1e-9);
  EXPECT_LT((splitting.weights() - before).cwiseAbs().maxCoeff(), 1e-4);
}

// The flux obeys its bound, and at the optimum it is phi A times the gradient's direction.
TYPED_TEST(CompactSplittingTest, FluxIsTheDualOfTheTotalVariation) {
  constexpr int kDim = TypeParam::value;
  const auto c = make_case<kDim>(Shape::kCorner);
  CompactSplitting<double, double, kDim> splitting(c.problem, c.metric, c.penalty, 1.5);
  splitting.start_from_harmonic(8);
  iterate(splitting, 4000);
  const auto weights = splitting.weights();
  const auto flux = splitting.flux();
  double aligned = 0;
  for (Index s = 0; s < c.problem.mesh.num_cells(); ++s) {
    const auto corners = cell_corners(c.problem.mesh, s);
    const double measure = simplex_measure<kDim>(corners);
    Eigen::MatrixXd corner_weights(weights.rows(), kDim + 1);
    for (int k = 0; k <= kDim; ++k) {
      corner_weights.col(k) = weights.col(c.problem.mesh.cells(k, s));
    }
    const PointList<kDim> gradient = linear_gradients<kDim>(corners, corner_weights);
    const auto p = flux.cell(s);
    for (Index i = 0; i < weights.rows(); ++i) {
      EXPECT_LE(p.col(i).norm(), std::max(c.problem.phi(i, s), 1e-10) * measure * (1 + 1e-9));
    }
    aligned += p.cwiseProduct(gradient).sum();
  }
  const double objective = testing::objective(c.problem.mesh, weights, c.problem.phi.dense());
  EXPECT_NEAR(aligned, objective, 1e-3 * objective);
}

template <class Scalar, class Stored, int Dim>
void expect_to_resume(const Case<Dim>& c) {
  const auto run = [&](StateStorage* storage, int count) {
    CompactSplitting<Scalar, Stored, Dim> splitting(c.problem, c.metric, c.penalty, 1.9,
                                                    LinearSolver::kDirect, storage);
    storage->penalty() > 0 ? splitting.resume() : splitting.start_from_harmonic(8);
    iterate(splitting, count);
    splitting.finish();
    storage->keep_penalty(c.penalty);
    return splitting.weights();
  };
  KeptState whole;
  KeptState parts;
  const auto expected = run(&whole, 20);
  EXPECT_GT((run(&parts, 12) - expected).cwiseAbs().maxCoeff(), 0);
  EXPECT_EQ((run(&parts, 8) - expected).cwiseAbs().maxCoeff(), 0);
}

TYPED_TEST(CompactSplittingTest, ResumesToTheBit) {
  constexpr int kDim = TypeParam::value;
  for (const bool non_negative : {false, true}) {
    const auto c = make_case<kDim>(Shape::kRing, non_negative);
    expect_to_resume<float, Half>(c);
    expect_to_resume<float, float>(c);
    expect_to_resume<double, double>(c);
  }
}

// P of half precision is a number of single precision, so nothing changes but what follows.
TYPED_TEST(CompactSplittingTest, GoesOnInSinglePrecision) {
  constexpr int kDim = TypeParam::value;
  const auto c = make_case<kDim>(Shape::kCorner);
  CompactSplitting<double, double, kDim> exact(c.problem, c.metric, c.penalty, 1.9);
  exact.start_from_harmonic(8);
  iterate(exact, 500);
  KeptState kept;
  for (StateStorage* storage :
       {static_cast<StateStorage*>(nullptr), static_cast<StateStorage*>(&kept)}) {
    CompactSplitting<float, Half, kDim> half(c.problem, c.metric, c.penalty, 1.9,
                                             LinearSolver::kDirect, storage);
    half.start_from_harmonic(8);
    iterate(half, 100);
    const auto weights = half.weights();
    CompactSplitting<float, float, kDim> single(std::move(half), storage);
    EXPECT_EQ((single.weights() - weights).cwiseAbs().maxCoeff(), 0);
    EXPECT_LT(single.iterate().change, 1e-2);
    iterate(single, 399);
    EXPECT_LT(squared_error(c.problem, single.weights(), exact.weights()), 1e-10);
  }
}

// On meshes so fine that half precision is taken.
TYPED_TEST(CompactSplittingTest, RunsInHalfPrecisionConvergeToSmallTolerances) {
  constexpr int kDim = TypeParam::value;
  const auto sample = make_sample<kDim>(Shape::kCorner, kDim == 2 ? 100 : 14, 0.2);
  const auto problem = make_problem(sample.cage, sample.mesh, DistanceScheme::kSquare);
  ASSERT_GT(problem.mesh.num_cells(), 10000);
  SolverOptions options;
  options.gap = 0;
  options.tolerance = 1e-7;
  options.precision = Precision::kSingle;
  const auto single = solve(problem, options);
  options.precision = Precision::kHalf;
  const auto half = solve(problem, options);
  EXPECT_EQ(half.report.status, SolveStatus::kConverged);
  EXPECT_LT(half.report.iterations, 1.5 * single.report.iterations);
  EXPECT_GT((half.weights - single.weights).cwiseAbs().maxCoeff(), 0);
  EXPECT_LT(squared_error(problem, half.weights, single.weights), 1e-7);
}

TYPED_TEST(CompactSplittingTest, AMultigridCycleLeadsToTheSameLimit) {
  constexpr int kDim = TypeParam::value;
  const auto c = make_case<kDim>(Shape::kCorner);
  const auto limit = [&](LinearSolver solver) {
    CompactSplitting<double, double, kDim> splitting(c.problem, c.metric, c.penalty, 1.5, solver);
    splitting.start_from_harmonic(8);
    iterate(splitting, 3000);
    return splitting.weights();
  };
  const WeightMatrix direct = limit(LinearSolver::kDirect);
  EXPECT_LT(squared_error(c.problem, limit(LinearSolver::kMultigrid), direct), 1e-9);
}

}  // namespace
}  // namespace flbc::testing
