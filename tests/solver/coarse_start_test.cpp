// SPDX-License-Identifier: BSD-3-Clause
// The start from the coarse mesh of a refined one: what carries over exactly, and that the answer
// stays the same.
#include "solver/methods/splitting/compact_splitting.h"
#include "solver/start/prolongation.h"
#include "support/refined_sample.h"
#include "support/solver_options.h"
#include "support/splitting_cases.h"

namespace flbc::testing {
namespace {

// A linear function per control point.
template <int Dim>
WeightMatrix linear_field(Index n, const PointList<Dim>& points) {
  WeightMatrix field(n, points.cols());
  for (Index i = 0; i < n; ++i) {
    const auto slope = Vector<Dim>::LinSpaced(0.1 * (i + 1), 1 - 0.05 * i);
    field.row(i) = (slope.transpose() * points).array() + i;
  }
  return field;
}

// A problem on a mesh and on its refinement.
template <int Dim>
struct TwoMeshes {
  LbcProblem<Dim> coarse;
  LbcProblem<Dim> fine;
  std::vector<std::array<Index, 2>> ends;

  TwoMeshes(Shape shape, DistanceScheme phi) {
    const auto sample = make_sample<Dim>(shape, 2, 0.2);
    coarse = make_problem(sample.cage, sample.mesh, phi, 0);
    fine = make_problem(sample.cage, refine(sample.mesh), phi, 0);
    ends = coarse_mesh(fine.mesh)->ends;
  }
};

TEST_IN_2D_AND_3D(CoarseStartTest, LinearWeightsAndConstantFluxesCarryOverExactly) {
  for (const auto shape : {Shape::kBox, Shape::kCorner, Shape::kRing, Shape::kStar}) {
    const TwoMeshes<Dim> meshes(shape, DistanceScheme::kConstant);
    const Index n = meshes.coarse.num_control_points();
    WarmStart<Dim> state;
    state.penalty = 2;
    state.weights = SparseWeights(linear_field<Dim>(n, meshes.coarse.mesh.points));
    state.vertex_dual = state.weights;
    const Vectors<Dim> density = Vectors<Dim>::Constant(n, Dim, 0.5);
    state.flux_density = {n, meshes.coarse.mesh.num_cells(), [&](Index) { return density; }};
    const Prolongation<Dim> prolongation(meshes.coarse, state, meshes.fine, meshes.ends);

    const auto expected = linear_field<Dim>(n, meshes.fine.mesh.points);
    const auto start = prolongation.start();
    const double largest = expected.cwiseAbs().maxCoeff();
    for (Index v = 0; v < meshes.fine.mesh.num_vertices(); ++v) {
      if (meshes.fine.boundary.boundary_index[v] >= 0) continue;
      EXPECT_LT((start.weights(v) - expected.col(v)).cwiseAbs().maxCoeff(), 1e-12 * largest);
      const Eigen::VectorXd dual = start.vertex_dual_at(1)(v);  // twice at half the penalty
      EXPECT_LT((dual - 2 * expected.col(v)).cwiseAbs().maxCoeff(), 1e-11 * largest);
    }
    EXPECT_EQ(start.penalty, 2);
    for (Index s = 0; s < meshes.fine.mesh.num_cells(); ++s) {
      EXPECT_LT((start.flux_density(s) - density).cwiseAbs().maxCoeff(), 1e-14);
    }
  }
}

TEST_IN_2D_AND_3D(CoarseStartTest, FluxNeverExceedsThePhiOfTheFineMesh) {
  const TwoMeshes<Dim> meshes(Shape::kBox, DistanceScheme::kSquare);
  const auto& [coarse, fine, ends] = meshes;
  const Index n = coarse.num_control_points();
  WarmStart<Dim> state;
  state.weights = SparseWeights(WeightMatrix::Zero(n, coarse.mesh.num_vertices()));
  state.flux_density = {n, coarse.mesh.num_cells(),
                        [&](Index) -> Vectors<Dim> { return Vectors<Dim>::Random(n, Dim); }};
  const Prolongation<Dim> prolongation(coarse, state, fine, ends);
  const auto start = prolongation.start();
  Index shortened = 0;
  for (Index s = 0; s < fine.mesh.num_cells(); ++s) {
    const auto density = start.flux_density(s);
    for (Index i = 0; i < n; ++i) {
      EXPECT_LE(density.row(i).norm(), fine.phi(i, s) * (1 + 1e-12));
      if (density.row(i).norm() > fine.phi(i, s) * (1 - 1e-12)) ++shortened;
    }
  }
  EXPECT_GT(shortened, 0);
  EXPECT_LT(shortened, n * fine.mesh.num_cells());
}

// Started from the duals of its optimum, the splitting stays there.
TEST_IN_2D_AND_3D(CoarseStartTest, SplittingContinuesFromItsOwnOptimum) {
  const auto sample = make_sample<Dim>(Shape::kCorner, Dim == 2 ? 6 : 4, 0.2);
  const auto problem = make_problem(sample.cage, sample.mesh, DistanceScheme::kSquare, 0);
  const auto metric = make_metric(problem, 1, true);
  compact::CompactSplitting<double, Dim> first(problem, metric, {0.016, 1.9});
  first.start({});
  first.iterate(0, 3000);
  const WeightMatrix weights = first.all_weights();
  const VectorsAt<1> own_dual = first.state().vertex_dual;
  const auto moved = [&](const VectorsAt<Dim>& flux_density, const VectorsAt<1>& dual) {
    compact::CompactSplitting<double, Dim> second(problem, metric, {0.016, 1.9});
    second.start(
        {0.016, [&](Index v) -> Eigen::VectorXd { return weights.col(v); }, flux_density, dual});
    EXPECT_LT((second.all_weights() - weights).cwiseAbs().maxCoeff(), 1e-14);
    double change = 0;
    for (int k = 0; k < 20; ++k) change += second.iterate(k, 1).change;
    return change;
  };
  const VectorsAt<Dim> own = [&](Index s) { return first.flux_density(s); };
  const VectorsAt<Dim> none = [&](Index) {
    return Vectors<Dim>::Zero(problem.num_control_points(), Dim).eval();
  };
  const double with_duals = moved(own, own_dual);
  EXPECT_LT(with_duals, 1e-6 * moved(none, own_dual));
  EXPECT_LT(with_duals, 0.1 * moved(own, {}));
}

// ---- the whole, on meshes made in code ----------------------------------------------------------

template <int Dim>
Sample<Dim> fine_sample() {
  return refined_sample<Dim>(Shape::kCorner, Dim == 2 ? 13 : 3);
}

SolverOptions with_tolerance(double tolerance) {
  SolverOptions options;
  options.distances = Distances::kExact;
  options.tolerance = tolerance;
  return options;
}

TEST_IN_2D_AND_3D(CoarseStartTest, AgreesWithTheColdStart) {
  const auto sample = fine_sample<Dim>();
  const auto optimum = solve(sample.cage, sample.mesh, many_iterations(800)).weights.dense();
  const auto warm = solve(sample.cage, sample.mesh, with_tolerance(1e-6));
  const auto cold = solve(sample.cage, in_other_order(sample.mesh), with_tolerance(1e-6));
  ASSERT_EQ(warm.report.status, SolveStatus::kConverged);
  EXPECT_TRUE(cold.report.coarse_levels.empty());
  EXPECT_LE(warm.report.iterations, cold.report.iterations);
  EXPECT_LT(mean_squared_difference(sample.mesh, warm.weights.dense(), optimum), 3e-6);
  expect_coordinates(sample.cage, sample.mesh, warm.weights.dense());
}

TEST_IN_2D_AND_3D(CoarseStartTest, ReportsTheCoarseMeshAndCountsItsSeconds) {
  const auto sample = fine_sample<Dim>();
  std::vector<int> seen;
  Observer observer;
  observer.progress = [&](const Progress& progress) {
    if (seen.empty() || seen.back() != progress.finer_levels) seen.push_back(progress.finer_levels);
    return true;
  };
  const auto report = solve(sample.cage, sample.mesh, with_tolerance(1e-7), observer).report;
  EXPECT_EQ(seen, (std::vector{1, 0}));
  ASSERT_EQ(report.coarse_levels.size(), 1U);
  const auto coarse = coarse_mesh(sample.mesh)->mesh;
  EXPECT_EQ(report.coarse_levels[0].vertices, coarse.num_vertices());
  EXPECT_EQ(report.coarse_levels[0].cells, coarse.num_cells());
  EXPECT_GT(report.coarse_levels[0].iterations, 0);
  EXPECT_GT(report.coarse_levels[0].solve_seconds, 0);
  EXPECT_GT(report.seconds.solve, report.coarse_levels[0].solve_seconds);
}

TEST_IN_2D_AND_3D(CoarseStartTest, OtherMethodsUseNoCoarseMesh) {
  const auto sample = refined_sample<Dim>(Shape::kCorner, 2);
  for (const auto method : {Method::kGradient, Method::kPaper, Method::kLbc2014}) {
    SolverOptions options{method};
    options.max_iterations = 30;
    EXPECT_TRUE(solve(sample.cage, sample.mesh, options).report.coarse_levels.empty());
  }
}

TEST_IN_2D_AND_3D(CoarseStartTest, ACoarseMeshWithoutAllControlPointsIsNotUsed) {
  // A midpoint on the cage becomes a control point.
  const auto mesh = refined_sample<Dim>(Shape::kBox, 2).mesh;
  const auto cage = boundary_of(mesh);
  EXPECT_TRUE(solve(cage, mesh).report.coarse_levels.empty());
}

TEST_IN_2D_AND_3D(CoarseStartTest, CanBeStoppedOnTheCoarseMesh) {
  const auto sample = fine_sample<Dim>();
  int calls = 0;
  Observer observer;
  observer.progress = [&](const Progress& progress) {
    EXPECT_GT(progress.finer_levels, 0);
    return ++calls < 2;
  };
  const auto solution = solve(sample.cage, sample.mesh, with_tolerance(1e-20), observer);
  EXPECT_EQ(calls, 2);
  EXPECT_EQ(solution.report.status, SolveStatus::kStopped);
  EXPECT_EQ(solution.report.iterations, 1);
  EXPECT_LT(solution.report.quality.max_reproduction_error, 1e-13);
}

TEST_IN_2D_AND_3D(CoarseStartTest, ThreadsDoNotChangeABit) {
  const auto sample = fine_sample<Dim>();
  expect_same_for_any_threads([&] {
    const auto solution = solve(sample.cage, sample.mesh, with_tolerance(1e-5));
    EXPECT_FALSE(solution.report.coarse_levels.empty());
    return solution.weights.dense();
  });
}

}  // namespace
}  // namespace flbc::testing
