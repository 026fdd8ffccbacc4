// SPDX-License-Identifier: BSD-3-Clause
// The start from a coarser mesh: what carries over exactly, and that the answer stays the same.
#include "solver/methods/splitting/compact_splitting.h"
#include "solver/plan/choices.h"
#include "solver/plan/constants.h"
#include "solver/start/transfer.h"
#include "support/coarse_sample_mesher.h"
#include "support/solver_options.h"
#include "support/splitting_cases.h"
#include "support/test.h"

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

// Two meshes of one cage that are not nested, the second elsewhere and at another scale.
template <int Dim>
struct TwoMeshes {
  LbcProblem<Dim> coarse;
  LbcProblem<Dim> fine;

  explicit TwoMeshes(Shape shape) {
    const auto sample = make_sample<Dim>(shape, 2, 0.2);
    coarse = make_problem(sample.cage, sample.mesh, DistanceScheme::kConstant, 0);
    auto finer = make_sample<Dim>(shape, 5, 0.2);
    finer.cage.points = (3 * finer.cage.points).colwise() + Vector<Dim>::Constant(40);
    finer.mesh.points = (3 * finer.mesh.points).colwise() + Vector<Dim>::Constant(40);
    fine = make_problem(finer.cage, finer.mesh, DistanceScheme::kConstant, 0);
  }
};

TEST_IN_2D_AND_3D(CoarseToFineTest, LinearWeightsAndConstantFluxesCarryOverExactly) {
  for (const auto shape : {Shape::kBox, Shape::kCorner, Shape::kRing, Shape::kStar}) {
    const TwoMeshes<Dim> meshes(shape);
    const Index n = meshes.coarse.num_control_points();
    Duals<Dim> state;
    state.penalty = 2;
    state.weights = SparseWeights(linear_field<Dim>(n, meshes.coarse.mesh.points));
    state.vertex_dual = state.weights;
    const Vectors<Dim> density = Vectors<Dim>::Constant(n, Dim, 0.5);
    state.flux_density = {n, meshes.coarse.mesh.num_cells(), [&](Index) { return density; }};
    const Transfer<Dim> transfer(meshes.coarse, state, meshes.fine);

    const auto expected = linear_field<Dim>(n, meshes.fine.mesh.points);
    const auto start = transfer.start();
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

TEST_IN_2D_AND_3D(CoarseToFineTest, FluxNeverExceedsThePhiOfTheFineMesh) {
  const auto coarse_sample = make_sample<Dim>(Shape::kBox, 2, 0.2);
  const auto sample = make_sample<Dim>(Shape::kBox, 5, 0.2);
  const auto coarse =
      make_problem(coarse_sample.cage, coarse_sample.mesh, DistanceScheme::kSquare, 0);
  const auto fine = make_problem(sample.cage, sample.mesh, DistanceScheme::kSquare, 0);
  const Index n = coarse.num_control_points();
  Duals<Dim> state;
  state.weights = SparseWeights(WeightMatrix::Zero(n, coarse.mesh.num_vertices()));
  state.flux_density = {n, coarse.mesh.num_cells(),
                        [&](Index) -> Vectors<Dim> { return Vectors<Dim>::Random(n, Dim); }};
  const Transfer<Dim> transfer(coarse, state, fine);
  const auto start = transfer.start();
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
TEST_IN_2D_AND_3D(CoarseToFineTest, SplittingContinuesFromItsOwnOptimum) {
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

// A cage with meshes of any fineness: the sample's shape, subdivided.
template <int Dim>
CoarseMesher<Dim> sample_mesher(Shape shape) {
  return [shape](const Cage<Dim>& cage, Index vertices) {
    Sample<Dim> sample;
    for (Index k = 1; sample.mesh.num_vertices() < vertices; ++k) {
      sample = make_sample<Dim>(shape, k, 0.2);
    }
    return mesh_in(cage, sample);
  };
}

template <int Dim>
Sample<Dim> fine_sample() {
  return make_sample<Dim>(Shape::kCorner, Dim == 2 ? 26 : 6, 0.2);
}

// Meshes this small need to be asked for it.
SolverOptions multilevel(double tolerance = 1e-6) {
  SolverOptions options;
  options.coarse_to_fine = CoarseToFine::kOn;
  options.distances = Distances::kExact;
  options.tolerance = tolerance;
  return options;
}

TEST_IN_2D_AND_3D(CoarseToFineTest, AgreesWithTheColdStartInFewerIterations) {
  const auto sample = fine_sample<Dim>();
  const auto optimum = solve(sample.cage, sample.mesh, many_iterations(800)).weights.dense();
  auto options = multilevel();
  const auto warm = solve(sample.cage, sample.mesh, options, sample_mesher<Dim>(Shape::kCorner));
  options.coarse_to_fine = CoarseToFine::kOff;
  const auto cold = solve(sample.cage, sample.mesh, options);
  ASSERT_EQ(warm.report.status, SolveStatus::kConverged);
  EXPECT_FALSE(warm.report.coarse_levels.empty());
  EXPECT_LT(warm.report.iterations, cold.report.iterations);
  EXPECT_LT(mean_squared_difference(sample.mesh, warm.weights.dense(), optimum), 3e-6);
  const auto judgement = judge(sample.cage, sample.mesh, warm.weights.dense());
  EXPECT_LT(judgement.partition_error, 1e-13);
  EXPECT_LT(judgement.reproduction_error, 1e-13);
  EXPECT_EQ(judgement.lagrange_error, 0);
}

TEST_IN_2D_AND_3D(CoarseToFineTest, ReportsEveryLevelAndCountsItsSeconds) {
  const auto sample = make_sample<Dim>(Shape::kCorner, Dim == 2 ? 42 : 13, 0.2);
  const auto options = multilevel(1e-5);
  std::vector<int> seen;
  Observer observer;
  observer.progress = [&](const Progress& progress) {
    if (seen.empty() || seen.back() != progress.finer_levels) seen.push_back(progress.finer_levels);
    return true;
  };
  const auto solution =
      solve(sample.cage, sample.mesh, options, sample_mesher<Dim>(Shape::kCorner), observer);
  const auto& report = solution.report;
  EXPECT_EQ(report.vertices, sample.mesh.num_vertices());
  ASSERT_FALSE(report.coarse_levels.empty());
  ASSERT_EQ(seen.size(), report.coarse_levels.size() + 1);
  Index below = 0;
  double seconds = 0;
  for (std::size_t k = 0; k < report.coarse_levels.size(); ++k) {
    const auto& level = report.coarse_levels[k];
    EXPECT_EQ(seen[k], static_cast<int>(report.coarse_levels.size() - k));
    EXPECT_GT(level.vertices, below);
    EXPECT_GT(level.cells, 0);
    EXPECT_GT(level.iterations, 0);
    EXPECT_GT(level.solve_seconds, 0);
    seconds += level.mesh_seconds + level.setup_seconds + level.solve_seconds;
    below = level.vertices;
  }
  EXPECT_LT(below, report.vertices);
  EXPECT_EQ(seen.back(), 0);
  EXPECT_GT(report.seconds.solve, seconds);
  EXPECT_GT(report.seconds.setup, 0);
}

// Without a usable coarse mesh, the result is bit-identical to a cold start.
TEST_IN_2D_AND_3D(CoarseToFineTest, SkipsALevelThatCannotBeMeshed) {
  const auto sample = make_sample<Dim>(Shape::kCorner, Dim == 2 ? 12 : 6, 0.2);
  auto options = multilevel(1e-5);
  options.coarse_to_fine = CoarseToFine::kOff;
  const auto cold = solve(sample.cage, sample.mesh, options);
  options.coarse_to_fine = CoarseToFine::kOn;
  const CoarseMesher<Dim> meshers[] = {
      [](const Cage<Dim>&, Index) -> DomainMesh<Dim> { throw OptionError("too fine a cage"); },
      [](const Cage<Dim>&, Index) -> DomainMesh<Dim> { throw std::bad_function_call(); },
      [](const Cage<Dim>&, Index) { return DomainMesh<Dim>{}; },
      [&](const Cage<Dim>& cage, Index) {
        return sample_mesher<Dim>(Shape::kCorner)(cage, sample.mesh.num_vertices());
      }};
  for (const auto& mesher : meshers) {
    const auto warm = solve(sample.cage, sample.mesh, options, mesher);
    EXPECT_TRUE(warm.report.coarse_levels.empty());
    EXPECT_TRUE((warm.weights.dense().array() == cold.weights.dense().array()).all());
  }
  const CoarseMesher<Dim> without_memory = [](const Cage<Dim>&, Index) -> DomainMesh<Dim> {
    throw std::bad_alloc();
  };
  EXPECT_THROW(solve(sample.cage, sample.mesh, options, without_memory), std::bad_alloc);
}

TEST_IN_2D_AND_3D(CoarseToFineTest, OtherMethodsUseNoCoarseMesh) {
  const auto sample = make_sample<Dim>(Shape::kCorner, 4, 0.2);
  int calls = 0;
  const CoarseMesher<Dim> mesher = [&](const Cage<Dim>& cage, Index vertices) {
    ++calls;
    return sample_mesher<Dim>(Shape::kCorner)(cage, vertices);
  };
  for (const auto method : {Method::kGradient, Method::kPaper, Method::kLbc2014}) {
    SolverOptions options;
    options.method = method;
    options.max_iterations = 30;
    options.coarse_to_fine = CoarseToFine::kOn;
    const auto same = solve(sample.cage, sample.mesh, options, mesher);
    options.coarse_to_fine = CoarseToFine::kOff;
    const auto plain = solve(sample.cage, sample.mesh, options);
    EXPECT_TRUE((same.weights.dense().array() == plain.weights.dense().array()).all());
  }
  EXPECT_EQ(calls, 0);
}

TEST_IN_2D_AND_3D(CoarseToFineTest, CanBeStoppedOnACoarseMesh) {
  const auto sample = fine_sample<Dim>();
  int calls = 0;
  Observer observer;
  observer.progress = [&](const Progress& progress) {
    EXPECT_GT(progress.finer_levels, 0);
    return ++calls < 2;
  };
  const auto solution = solve(sample.cage, sample.mesh, multilevel(1e-20),
                              sample_mesher<Dim>(Shape::kCorner), observer);
  EXPECT_EQ(calls, 2);
  EXPECT_EQ(solution.report.status, SolveStatus::kStopped);
  EXPECT_EQ(solution.report.iterations, 1);
  EXPECT_LT(solution.report.quality.max_reproduction_error, 1e-13);
}

TEST_IN_2D_AND_3D(CoarseToFineTest, ThreadsDoNotChangeABit) {
  const auto sample = make_sample<Dim>(Shape::kCorner, Dim == 2 ? 14 : 6, 0.2);
  expect_same_for_any_threads([&] {
    const auto solution =
        solve(sample.cage, sample.mesh, multilevel(1e-5), sample_mesher<Dim>(Shape::kCorner));
    EXPECT_FALSE(solution.report.coarse_levels.empty());
    return solution.weights.dense();
  });
}

TEST_IN_2D_AND_3D(CoarseToFineTest, RefusesAMeshOfSomethingElse) {
  const auto sample = make_sample<Dim>(Shape::kCorner, Dim == 2 ? 12 : 6, 0.2);
  const auto wrong = [](const Cage<Dim>&, Index) { return make_sample<Dim>(Shape::kStar, 3).mesh; };
  EXPECT_THROW(solve(sample.cage, sample.mesh, multilevel(), wrong), InputError);
}

// ---- the choice of levels -----------------------------------------------------------------------

std::vector<Index> coarse_sizes(const plan::Sizes& sizes, CoarseToFine choice,
                                bool on_active_set = false) {
  SolverOptions options;
  options.coarse_to_fine = choice;
  options.active_set = on_active_set ? ActiveSet::kOn : ActiveSet::kOff;
  return plan::coarse_sizes(sizes, plan::settings_of(options));
}

TEST(CoarseSizes, AreOffOnOrWhereTheyPay) {
  for (const plan::Sizes& small : {plan::Sizes{2, 6, 1000}, {3, 10, 2000}}) {
    EXPECT_TRUE(coarse_sizes(small, CoarseToFine::kAuto).empty());
    EXPECT_FALSE(coarse_sizes(small, CoarseToFine::kOn).empty());
  }
  for (const plan::Sizes& large : {plan::Sizes{2, 100, 100000}, {3, 100, 100000}}) {
    EXPECT_FALSE(coarse_sizes(large, CoarseToFine::kAuto).empty());
    EXPECT_TRUE(coarse_sizes(large, CoarseToFine::kOff).empty());
  }
  EXPECT_TRUE(coarse_sizes({3, 110, 6000}, CoarseToFine::kAuto).empty());
  EXPECT_FALSE(coarse_sizes({3, 110, 6000}, CoarseToFine::kAuto, true).empty());
}

TEST(CoarseSizes, AscendToTheFinestMesh) {
  for (const int dim : {2, 3}) {
    const auto sizes = coarse_sizes({dim, 9, 100000}, CoarseToFine::kOn);
    ASSERT_GE(sizes.size(), 2U);
    EXPECT_GE(sizes.front(), plan::kCoarsest);
    EXPECT_LT(plan::kClearlyFiner * sizes.back(), 100000);
    for (std::size_t k = 1; k < sizes.size(); ++k) {
      EXPECT_LT(plan::kClearlyFiner * sizes[k - 1], sizes[k]);
    }
    EXPECT_TRUE(coarse_sizes({dim, 9, 2 * plan::kCoarsest - 1}, CoarseToFine::kOn).empty());
  }
}

}  // namespace
}  // namespace flbc::testing
