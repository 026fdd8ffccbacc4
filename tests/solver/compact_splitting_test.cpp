// SPDX-License-Identifier: BSD-3-Clause
// The compact form of the splitting on the weights against the textbook solver of problem (2),
// iterate by iterate, and what it must keep beyond that.
#include "solver/methods/splitting/compact_splitting.h"

#include "flbc/harmonic.h"
#include "flbc/non_negative.h"
#include "flbc/options.h"
#include "flbc/solver.h"
#include "support/published_problem.h"
#include "support/refined_sample.h"
#include "support/splitting_cases.h"

namespace flbc::testing {
namespace {

using compact::CompactSplitting;

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
  auto problem = make_problem(sample.cage, sample.mesh, DistanceScheme::kSquare, 0);
  auto metric = make_metric(problem, 1, non_negative);
  const double penalty = make_penalty(problem, metric);
  return {std::move(problem), std::move(metric), penalty};
}

template <int Dim>
Case<Dim> make_case(Shape shape, bool non_negative = true) {
  return make_case(make_sample<Dim>(shape, 4, 0.2), non_negative);
}

template <class Scalar, int Dim>
CompactSplitting<Scalar, Dim> make_splitting(const Case<Dim>& c, double relaxation = 1.9) {
  return {c.problem, c.metric, {c.penalty, relaxation}};
}

// The violation of all constraints by the next z_step and w_step, of cells with interior corners.
template <int Dim>
double expected_primal(const LbcProblem<Dim>& problem, TextbookLbc2014<Dim> textbook) {
  textbook.iterate();
  double sum = textbook.squared_violation_of_weights();
  for (Index s = 0; s < problem.mesh.num_cells(); ++s) {
    bool is_inner = false;
    for (const Index v : problem.mesh.cells.col(s)) is_inner |= problem.boundary.is_interior(v);
    if (is_inner) sum += textbook.squared_violation_of_cell(s);
  }
  return std::sqrt(sum);
}

TEST_IN_2D_AND_3D(CompactSplittingTest, EqualsTheTextbookIterateByIterate) {
  auto all = samples<Dim>();
  all.push_back(Dim == 2 ? with_many_control_points<Dim>(7, 14)
                         : with_many_control_points<Dim>(2, 4));
  for (const auto& sample : all) {
    // Smoothness is for the metric A only.
    for (const auto& [non_negative, power, smoothness] :
         {std::tuple(false, 2, 0.0), {true, 1, 0.0}, {false, 1, 0.02}, {true, 1, 0.02}}) {
      if (smoothness > 0 && sample.name.find("box") == 0) continue;  // other shapes suffice
      SCOPED_TRACE(sample.name + ", metric A^" + std::to_string(power) + ", smoothness " +
                   std::to_string(smoothness));
      const auto problem =
          make_problem(sample.cage, sample.mesh, DistanceScheme::kSquare, smoothness);
      const auto metric = make_metric(problem, power, non_negative);
      const double penalty = make_penalty(problem, metric);
      const double relaxation = non_negative ? 1.65 : 1;
      const auto start = harmonic_coordinates(problem);
      auto textbook = textbook_for(problem, metric, penalty, relaxation, start);
      compact::Parameters parameters{penalty, relaxation};
      parameters.paper_residuals = true;
      CompactSplitting<double, Dim> splitting(problem, metric, parameters);
      splitting.start_from_weights(start);
      for (int made = 0; made < 12; ++made) {
        const auto before = textbook.weights();
        textbook.iterate();
        const Step step = splitting.iterate(made, 1);
        ASSERT_LT((splitting.all_weights() - textbook.weights()).cwiseAbs().maxCoeff(), 1e-10)
            << "after iteration " << made;
        const double expected = (textbook.weights() - before).squaredNorm();
        EXPECT_NEAR(step.change, expected, 1e-6 * expected + 1e-14);
        const bool measures = (made + 1) % splitting.interval() == 0;
        EXPECT_EQ(step.dual > 0 || step.change < 1e-14, measures || step.change < 1e-14);
        if (!measures) continue;
        const double cells = Dim * problem.mesh.num_cells();
        const double rows =
            non_negative ? static_cast<double>(problem.boundary.interior_vertices().size()) : 0;
        const double components = (cells + rows) * problem.num_control_points();
        const double dual = textbook.dual_residual_norm() / components;
        EXPECT_NEAR(step.dual, dual, 1e-6 * dual + 1e-12);
        const double primal = expected_primal(problem, textbook) / components;
        EXPECT_NEAR(step.primal, primal, 1e-6 * primal + 1e-12);
      }
      // Not by stagnation, except on a simplex, whose weights are unique.
      if (sample.cage.size() == Dim + 1) continue;
      EXPECT_GT((splitting.all_weights() - start).cwiseAbs().maxCoeff(), 1e-3);
    }
  }
}

// The same limit, by every set of loops this processor can run.
template <class Scalar, int Dim>
void expect_to_follow(const Case<Dim>& c, const WeightMatrix& exact, double tolerance) {
  const auto list = supported_kernels<compact::Kernel<Scalar, Dim>>();
  for (int k = 0; k < list.size; ++k) {
    CompactSplitting<Scalar, Dim> splitting(c.problem, c.metric, {c.penalty, 1.9},
                                            *list.kernels[k]);
    splitting.start({});
    splitting.iterate(0, 400);
    EXPECT_LT(squared_error(c.problem, splitting.all_weights(), exact), tolerance)
        << "kernel " << k;
  }
}

TEST_IN_2D_AND_3D(CompactSplittingTest, AllKernelsHaveOneLimit) {
  const auto c = make_case<Dim>(Shape::kCorner);
  auto exact = make_splitting<double>(c);
  exact.start({});
  exact.iterate(0, 400);
  expect_to_follow<double>(c, exact.all_weights(), 1e-20);
  expect_to_follow<float>(c, exact.all_weights(), 1e-10);
}

// The weights, and the sum of the flux densities of all cells.
template <class Scalar, int Dim>
std::pair<WeightMatrix, Eigen::MatrixXd> run_with_threads(const Case<Dim>& c, int count) {
  const ThreadScope threads(count);
  auto splitting = make_splitting<Scalar>(c);
  splitting.start({});
  for (int made = 0; made < 12; ++made) splitting.iterate(made, 1);
  Eigen::MatrixXd flux = splitting.flux_density(0);
  for (Index s = 1; s < c.problem.mesh.num_cells(); ++s) flux += splitting.flux_density(s);
  return {splitting.all_weights(), flux};
}

// Arrays of cells come in slices of control points, one per thread.
TEST_IN_2D_AND_3D(CompactSplittingTest, IsTheSameForAnyNumberOfThreads) {
  std::vector<Case<Dim>> cases{make_case<Dim>(Shape::kCorner)};
  for (const Index cage_subdivisions : {Dim == 2 ? 7 : 2, Dim == 2 ? 25 : 5}) {
    cases.push_back(make_case(with_many_control_points<Dim>(cage_subdivisions, cage_subdivisions)));
    ASSERT_GT(cases.back().problem.num_control_points(), 32);
  }
  for (const auto& c : cases) {
    const auto single = run_with_threads<float>(c, 1);
    const auto exact = run_with_threads<double>(c, 1);
    EXPECT_GT(exact.second.norm(), 0);
    for (const int count : {2, 3, 7}) {
      EXPECT_EQ(run_with_threads<float>(c, count), single);
      EXPECT_EQ(run_with_threads<double>(c, count), exact);
    }
  }
}

// The flux obeys its bound, and at the optimum it is phi A times the gradient's direction.
TEST_IN_2D_AND_3D(CompactSplittingTest, FluxIsTheDualOfTheTotalVariation) {
  const auto c = make_case<Dim>(Shape::kCorner);
  auto splitting = make_splitting<double>(c, 1.5);
  splitting.start({});
  splitting.iterate(0, 4000);
  const auto weights = splitting.all_weights();
  double aligned = 0;
  const auto numbers = splitting.flux();
  const Index n = c.problem.num_control_points();
  const CellFieldView<double, Dim> flux{numbers.data(), padded(static_cast<std::size_t>(n)), n};
  for (Index s = 0; s < c.problem.mesh.num_cells(); ++s) {
    const auto corners = cell_corners(c.problem.mesh, s);
    const double measure = simplex_measure<Dim>(corners);
    const PointList<Dim> gradient =
        linear_gradients<Dim>(corners, columns_of(weights, c.problem.mesh.cells.col(s)));
    const auto p = flux.cell(s);
    for (Index i = 0; i < weights.rows(); ++i) {
      EXPECT_LE(p.col(i).norm(), std::max(c.problem.phi(i, s), 1e-10) * measure * (1 + 1e-9));
    }
    aligned += p.cwiseProduct(gradient).sum();
  }
  const double objective = testing::objective(c.problem.mesh, weights, c.problem.phi.dense());
  EXPECT_NEAR(aligned, objective, 1e-3 * objective);
}

// kLbc2014 from its start to delivered weights, with the penalty of the literature: cells weigh
// their squared measure, W = w weighs 1, relaxation 1.65, harmonic coordinates first.
TEST_IN_2D_AND_3D(CompactSplittingTest, AGivenPenaltyRunsTheTextbookIteration) {
  for (const auto& sample : samples<Dim>()) {
    SCOPED_TRACE(sample.name);
    const auto problem = published_problem(sample.cage, sample.mesh, DistanceScheme::kSquare);
    auto metric = make_metric(problem, 2, true);
    metric.vertex.setOnes();
    SolverOptions options;
    options.method = Method::kLbc2014;
    options.precision = Precision::kDouble;
    options.penalty = published_penalty(sample.cage, sample.mesh, Method::kLbc2014, 10);
    options.tolerance = 1e-30;
    for (const int iterations : {1, 7, 20}) {
      options.max_iterations = iterations;
      const auto solution = solve(sample.cage, sample.mesh, options);
      auto expected = textbook_for(problem, metric, 10, 1.65, harmonic_coordinates(problem));
      for (int k = 0; k < iterations; ++k) expected.iterate();
      const auto weights =
          project_non_negative(problem.cage.points, problem.mesh.points, expected.weights(),
                               problem.boundary.interior_vertices())
              .dense();
      EXPECT_LT((solution.weights.dense() - weights).cwiseAbs().maxCoeff(), 1e-8) << iterations;
      EXPECT_NEAR(solution.report.published_penalty, 10, 1e-9);
    }
  }
}

// Weighted by the measure, the start is harmonic coordinates, for any vertex weights.
TEST_IN_2D_AND_3D(CompactSplittingTest, StartsFromHarmonicCoordinatesByItsOwnFactor) {
  for (const auto& sample : samples<Dim>()) {
    const auto problem = make_problem(sample.cage, sample.mesh, DistanceScheme::kSquare, 0);
    const auto expected = harmonic_coordinates(problem);
    for (const bool non_negative : {false, true}) {
      SCOPED_TRACE(sample.name + (non_negative ? ", w >= 0" : ""));
      const auto metric = make_metric(problem, 1, non_negative);
      CompactSplitting<double, Dim> splitting(problem, metric, {1, 1.5});
      splitting.start_from_harmonic(40);
      EXPECT_LT((splitting.all_weights() - expected).cwiseAbs().maxCoeff(),
                non_negative ? 1e-3 : 1e-10);
      EXPECT_EQ(bool(splitting.state().vertex_dual), non_negative);
    }
  }
}

// With hardly any relaxation an iteration is nothing but its linear system, which duals from
// elsewhere must leave without effect, whatever they are.
TEST_IN_2D_AND_3D(CompactSplittingTest, DualsFromElsewhereDoNotMoveTheWeights) {
  const auto sample = make_sample<Dim>(Shape::kCorner, 3, 0.2);
  const auto problem = make_problem(sample.cage, sample.mesh, DistanceScheme::kSquare, 0);
  const auto metric = make_metric(problem, 2, true);
  const auto start = harmonic_coordinates(problem);
  const auto n = start.rows();
  const Eigen::MatrixXd density = Eigen::MatrixXd::Random(n, Dim * problem.mesh.num_cells());
  const WeightMatrix dual = WeightMatrix::Random(n, start.cols());
  const double penalty = make_penalty(problem, metric);
  CompactSplitting<double, Dim> splitting(problem, metric, {penalty, 1e-12});
  Start<Dim> from;
  from.penalty = penalty;
  from.weights = [&](Index v) -> Eigen::VectorXd { return start.col(v); };
  from.flux_density = [&](Index s) { return density.template middleCols<Dim>(Dim * s).eval(); };
  from.vertex_dual = [&](Index v) -> Eigen::VectorXd { return dual.col(v); };
  splitting.start(from);
  EXPECT_LT((splitting.all_weights() - start).cwiseAbs().maxCoeff(), 1e-13);
  splitting.iterate(0, 1);
  EXPECT_LT((splitting.all_weights() - start).cwiseAbs().maxCoeff(), 1e-8);
}

// (5) of the paper, by an independent sum.
TEST_IN_2D_AND_3D(CompactSplittingTest, SquaredErrorIsTheMeanOverInteriorVertices) {
  const auto sample = make_sample<Dim>(Shape::kCorner, 3, 0.2);
  const auto problem = make_problem(sample.cage, sample.mesh, DistanceScheme::kSquare, 0);
  const auto a = harmonic_coordinates(problem);
  WeightMatrix b = a;
  b.array() += Eigen::ArrayXXd::Random(b.rows(), b.cols());
  const double expected = mean_squared_difference(problem.mesh, a, b);
  EXPECT_NEAR(flbc::squared_error(problem, a, b), expected, 1e-12 * expected);
  EXPECT_THROW(flbc::squared_error(problem, a, WeightMatrix(b.leftCols(1))), InputError);
}

}  // namespace
}  // namespace flbc::testing
