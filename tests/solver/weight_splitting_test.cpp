// SPDX-License-Identifier: BSD-3-Clause
// The splitting on the weights against the textbook solver of problem (2), iterate by iterate.
#include "solver/splitting/weight_splitting.h"

#include <type_traits>

#include <gtest/gtest.h>

#include "base/parallel.h"
#include "flbc/errors.h"
#include "flbc/harmonic.h"
#include "flbc/quality.h"
#include "flbc/recovery.h"
#include "support/judge.h"
#include "support/sample_meshes.h"
#include "support/simplex.h"
#include "support/textbook_lbc2014.h"

namespace flbc::testing {
namespace {

using splitting::Metric;
using splitting::WeightSplitting;

template <class Dimension>
class WeightSplittingTest : public ::testing::Test {};
using Dimensions = ::testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(WeightSplittingTest, Dimensions);

// Cells weighted by a power of their measure, vertices by something uneven.
template <int Dim>
Metric make_metric(const LbcProblem<Dim>& problem, double power, bool non_negative) {
  Metric metric;
  metric.cell.resize(problem.mesh.num_cells());
  for (Index s = 0; s < problem.mesh.num_cells(); ++s) {
    metric.cell[s] = std::pow(simplex_measure<Dim>(cell_corners(problem.mesh, s)), power);
  }
  if (non_negative) {
    const double typical = metric.cell.mean() / 1000;
    metric.vertex = Eigen::VectorXd::LinSpaced(problem.mesh.num_vertices(), typical, 3 * typical);
  }
  return metric;
}

// A penalty that lets some balls of the Z-step be active and some not.
template <int Dim>
double make_penalty(const LbcProblem<Dim>& problem, const Metric& metric) {
  double volume = 0;
  for (Index s = 0; s < problem.mesh.num_cells(); ++s) {
    volume += simplex_measure<Dim>(cell_corners(problem.mesh, s));
  }
  return 10 * volume / metric.cell.sum();
}

template <int Dim>
TextbookLbc2014<Dim> textbook_for(const LbcProblem<Dim>& problem, const Metric& metric,
                                  double penalty, double relaxation, const WeightMatrix& start) {
  Lbc2014Input<Dim> input;
  input.control_points = problem.cage.points;
  input.mesh = problem.mesh;
  input.phi = problem.phi;
  input.initial_weights = start;
  for (Index v = 0; v < problem.mesh.num_vertices(); ++v) {
    if (problem.boundary.boundary_index[v] < 0) input.interior.push_back(v);
  }
  input.cell_metric = metric.cell;
  input.vertex_metric = metric.vertex;
  input.penalty = penalty;
  input.relaxation = relaxation;
  // The library starts with y = z + u = 0, so that u = -grad w.
  input.initial_z_dual.resize(start.rows(), Dim * problem.mesh.num_cells());
  for (Index s = 0; s < problem.mesh.num_cells(); ++s) {
    Eigen::MatrixXd corner_weights(start.rows(), Dim + 1);
    for (int k = 0; k <= Dim; ++k) corner_weights.col(k) = start.col(problem.mesh.cells(k, s));
    input.initial_z_dual.middleCols(Dim * s, Dim) =
        -linear_gradients<Dim>(cell_corners(problem.mesh, s), corner_weights).transpose();
  }
  return TextbookLbc2014<Dim>(std::move(input));
}

TYPED_TEST(WeightSplittingTest, EqualsTheTextbookIterateByIterate) {
  constexpr int kDim = TypeParam::value;
  for (const auto& sample : samples<kDim>()) {
    for (const bool non_negative : {false, true}) {
      const double power = non_negative ? 1 : 2;
      SCOPED_TRACE(sample.name + ", metric A^" + std::to_string(power));
      const auto problem = make_problem(sample.cage, sample.mesh, DistanceScheme::kSquare);
      const auto metric = make_metric(problem, power, non_negative);
      const double penalty = make_penalty(problem, metric);
      const double relaxation = non_negative ? 1.65 : 1;
      const auto start = harmonic_coordinates(problem);
      auto textbook = textbook_for(problem, metric, penalty, relaxation, start);
      WeightSplitting<double, kDim> splitting(problem, metric, penalty, relaxation);
      splitting.start_from_weights(start);
      for (int iteration = 1; iteration <= 15; ++iteration) {
        textbook.iterate();
        const auto residuals = splitting.iterate_with_residuals();
        ASSERT_LT((splitting.weights() - textbook.weights()).cwiseAbs().maxCoeff(), 1e-10)
            << "iteration " << iteration;
        EXPECT_NEAR(residuals.primal, textbook.primal_residual_norm(),
                    1e-8 * textbook.primal_residual_norm() + 1e-12);
        EXPECT_NEAR(residuals.dual, textbook.dual_residual_norm(),
                    1e-6 * textbook.dual_residual_norm() + 1e-12);
      }
      // Not by standing still; but a simplex leaves nothing to choose.
      if (sample.cage.size() == kDim + 1) continue;
      EXPECT_GT((splitting.weights() - start).cwiseAbs().maxCoeff(), 1e-3);
    }
  }
}

TYPED_TEST(WeightSplittingTest, IsTheSameForAnyNumberOfThreads) {
  constexpr int kDim = TypeParam::value;
  const auto sample = make_sample<kDim>(Shape::kCorner, 4, 0.2);
  const auto problem = make_problem(sample.cage, sample.mesh, DistanceScheme::kSquare);
  const auto metric = make_metric(problem, 1, true);
  const auto run = [&](int count) {
    const ThreadScope threads(count);
    WeightSplitting<float, kDim> splitting(problem, metric, make_penalty(problem, metric), 1.9);
    splitting.start_from_harmonic(8);
    for (int iteration = 0; iteration < 12; ++iteration) {
      splitting.iterate();
      if (iteration == 5) splitting.adapt_penalty(0.3);
    }
    splitting.iterate_with_residuals();
    return splitting.weights();
  };
  const auto one = run(1);
  EXPECT_EQ((run(2) - one).cwiseAbs().maxCoeff(), 0);
  EXPECT_EQ((run(4) - one).cwiseAbs().maxCoeff(), 0);
}

// (5) of the paper, by the judge's own sum.
TYPED_TEST(WeightSplittingTest, SquaredErrorIsTheMeanOverInteriorVertices) {
  constexpr int kDim = TypeParam::value;
  const auto sample = make_sample<kDim>(Shape::kCorner, 3, 0.2);
  const auto problem = make_problem(sample.cage, sample.mesh, DistanceScheme::kSquare);
  const auto a = harmonic_coordinates(problem);
  WeightMatrix b = a;
  b.array() += Eigen::ArrayXXd::Random(b.rows(), b.cols());
  const double expected = mean_squared_difference(problem.mesh, a, b);
  EXPECT_NEAR(flbc::squared_error(problem, a, b), expected, 1e-12 * expected);
  EXPECT_THROW(flbc::squared_error(problem, a, b.leftCols(1)), InputError);
}

// Whatever the penalty is changed to on the way, the duals survive and the optimum stays.
TYPED_TEST(WeightSplittingTest, AdaptingThePenaltyKeepsTheDuals) {
  constexpr int kDim = TypeParam::value;
  const auto sample = make_sample<kDim>(Shape::kRing, 4, 0.2);
  const auto problem = make_problem(sample.cage, sample.mesh, DistanceScheme::kSquare);
  const auto metric = make_metric(problem, 1, true);
  WeightSplitting<double, kDim> splitting(problem, metric, make_penalty(problem, metric), 1.5);
  splitting.start_from_harmonic(8);
  for (int iteration = 0; iteration < 3000; ++iteration) splitting.iterate();
  const auto before = splitting.weights();
  const double penalty = splitting.penalty();
  splitting.adapt_penalty(0.01);
  EXPECT_GT(std::abs(std::log(splitting.penalty() / penalty)), 1);
  double change = 0;
  for (int iteration = 0; iteration < 10; ++iteration) change += splitting.iterate().change;
  EXPECT_LT(change, 1e-9);
  EXPECT_LT((splitting.weights() - before).cwiseAbs().maxCoeff(), 1e-4);
}

// The flux obeys its bound, and at the optimum it is phi A times the gradient's direction.
TYPED_TEST(WeightSplittingTest, FluxIsTheDualOfTheTotalVariation) {
  constexpr int kDim = TypeParam::value;
  const auto sample = make_sample<kDim>(Shape::kCorner, 3, 0.2);
  const auto problem = make_problem(sample.cage, sample.mesh, DistanceScheme::kSquare);
  for (const double power : {1.0, 2.0}) {
    const auto metric = make_metric(problem, power, true);
    WeightSplitting<double, kDim> splitting(problem, metric, make_penalty(problem, metric), 1.5);
    splitting.start_from_harmonic(8);
    for (int iteration = 0; iteration < 4000; ++iteration) splitting.iterate();
    const auto weights = splitting.weights();
    const auto flux = splitting.flux();
    double aligned = 0;
    for (Index s = 0; s < problem.mesh.num_cells(); ++s) {
      const double measure = simplex_measure<kDim>(cell_corners(problem.mesh, s));
      Eigen::MatrixXd corner_weights(weights.rows(), kDim + 1);
      for (int k = 0; k <= kDim; ++k) corner_weights.col(k) = weights.col(problem.mesh.cells(k, s));
      const PointList<kDim> gradient =
          linear_gradients<kDim>(cell_corners(problem.mesh, s), corner_weights);
      const auto p = flux.cell(s);
      for (Index i = 0; i < weights.rows(); ++i) {
        EXPECT_LE(p.col(i).norm(), std::max(problem.phi(i, s), 1e-10) * measure * (1 + 1e-9));
      }
      aligned += p.cwiseProduct(gradient).sum();
    }
    const double objective = testing::objective(problem.mesh, weights, problem.phi);
    EXPECT_NEAR(aligned, objective, 1e-3 * objective);
  }
}

}  // namespace
}  // namespace flbc::testing
