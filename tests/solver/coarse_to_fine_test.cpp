// SPDX-License-Identifier: BSD-3-Clause
// The start from a coarser mesh: what carries over exactly, and that the answer stays the same.
#include "flbc/solver.h"

#include <type_traits>

#include <gtest/gtest.h>

#include "flbc/bounding_box.h"
#include "flbc/errors.h"
#include "flbc/harmonic.h"
#include "flbc/recovery.h"
#include "solver/gradient/boundary_periods.h"
#include "solver/gradient/gradient_admm.h"
#include "solver/multilevel/level_sizes.h"
#include "solver/splitting/compact_splitting.h"
#include "solver/warm_start/transfer.h"
#include "support/hollow_sample.h"
#include "support/judge.h"
#include "support/sample_meshes.h"

namespace flbc::testing {
namespace {

template <class Dimension>
class CoarseToFineTest : public ::testing::Test {};
using Dimensions = ::testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(CoarseToFineTest, Dimensions);

template <int Dim>
using Vectors = Eigen::Matrix<double, Eigen::Dynamic, Dim>;

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
struct Pair {
  LbcProblem<Dim> coarse;
  LbcProblem<Dim> fine;

  explicit Pair(Shape shape) {
    const auto sample = make_sample<Dim>(shape, 2, 0.2);
    coarse = make_problem(sample.cage, sample.mesh, DistanceScheme::kConstant);
    const auto finer = make_sample<Dim>(shape, 5, 0.2);
    fine = make_problem(finer.cage, finer.mesh, DistanceScheme::kConstant);
    fine.cage.points = (3 * fine.cage.points).colwise() + Vector<Dim>::Constant(40);
    fine.mesh.points = (3 * fine.mesh.points).colwise() + Vector<Dim>::Constant(40);
  }

  // Fine points in the coarse mesh's space.
  PointList<Dim> back(const PointList<Dim>& points) const {
    return (points.colwise() - Vector<Dim>::Constant(40)) / 3;
  }
};

TYPED_TEST(CoarseToFineTest, LinearWeightsAndConstantFluxesCarryOverExactly) {
  constexpr int kDim = TypeParam::value;
  for (const auto shape : {Shape::kBox, Shape::kCorner, Shape::kRing, Shape::kStar}) {
    const Pair<kDim> meshes(shape);
    const Index n = meshes.coarse.num_control_points();
    MeshState<kDim> state;
    state.penalty = 2;
    state.weights = SparseWeights(linear_field<kDim>(n, meshes.coarse.mesh.points));
    state.vertex_dual = state.weights;
    const Vectors<kDim> density = Vectors<kDim>::Constant(n, kDim, 0.5);
    state.flux_density = {n, meshes.coarse.mesh.num_cells(), [&](Index) { return density; }};
    const Transfer<kDim> transfer(meshes.coarse, state, meshes.fine);

    const auto expected = linear_field<kDim>(n, meshes.back(meshes.fine.mesh.points));
    const auto weights = transfer.weights();
    const double largest = expected.cwiseAbs().maxCoeff();
    for (Index v = 0; v < meshes.fine.mesh.num_vertices(); ++v) {
      if (meshes.fine.boundary.boundary_index[v] >= 0) continue;
      EXPECT_LT((weights.col(v) - expected.col(v)).cwiseAbs().maxCoeff(), 1e-12 * largest);
    }
    EXPECT_NEAR(transfer.penalty(), 6, 1e-12);
    const WeightMatrix dual = transfer.vertex_dual(3);  // twice as much at half the penalty
    EXPECT_LT((dual - 2 * expected).cwiseAbs().maxCoeff(), 1e-11 * largest);
    for (Index s = 0; s < meshes.fine.mesh.num_cells(); ++s) {
      EXPECT_LT((transfer.flux_density(s) - density).cwiseAbs().maxCoeff(), 1e-14);
    }
  }
}

TYPED_TEST(CoarseToFineTest, BoundaryValuesAreExactWhateverTheCoarseWeights) {
  constexpr int kDim = TypeParam::value;
  const auto coarse_sample = make_sample<kDim>(Shape::kCorner, 2, 0.2);
  const auto sample = make_sample<kDim>(Shape::kCorner, 5, 0.2);
  const auto coarse = make_problem(coarse_sample.cage, coarse_sample.mesh, DistanceScheme::kSquare);
  const auto fine = make_problem(sample.cage, sample.mesh, DistanceScheme::kSquare);
  MeshState<kDim> state;
  state.penalty = 1;
  state.weights = SparseWeights(
      WeightMatrix::Random(coarse.num_control_points(), coarse.mesh.num_vertices()));
  const auto weights = Transfer<kDim>(coarse, state, fine).weights();
  const auto demanded = demanded_boundary_weights(sample.cage, sample.mesh);
  for (const Index v : fine.boundary.vertices) {
    EXPECT_LT((weights.col(v) - demanded.col(v)).cwiseAbs().maxCoeff(), 1e-11);
  }
}

TYPED_TEST(CoarseToFineTest, FluxNeverExceedsThePhiOfTheFineMesh) {
  constexpr int kDim = TypeParam::value;
  const auto coarse_sample = make_sample<kDim>(Shape::kBox, 2, 0.2);
  const auto sample = make_sample<kDim>(Shape::kBox, 5, 0.2);
  const auto coarse = make_problem(coarse_sample.cage, coarse_sample.mesh, DistanceScheme::kSquare);
  const auto fine = make_problem(sample.cage, sample.mesh, DistanceScheme::kSquare);
  const Index n = coarse.num_control_points();
  MeshState<kDim> state;
  state.weights = SparseWeights(WeightMatrix::Zero(n, coarse.mesh.num_vertices()));
  state.flux_density = {n, coarse.mesh.num_cells(),
                        [&](Index) -> Vectors<kDim> { return Vectors<kDim>::Random(n, kDim); }};
  const Transfer<kDim> transfer(coarse, state, fine);
  Index shortened = 0;
  for (Index s = 0; s < fine.mesh.num_cells(); ++s) {
    const auto density = transfer.flux_density(s);
    for (Index i = 0; i < n; ++i) {
      EXPECT_LE(density.row(i).norm(), fine.phi(i, s) * (1 + 1e-12));
      if (density.row(i).norm() > fine.phi(i, s) * (1 - 1e-12)) ++shortened;
    }
  }
  EXPECT_GT(shortened, 0);
  EXPECT_LT(shortened, n * fine.mesh.num_cells());
}

// Stokes' theorem: the multipliers of a linear potential add up, over the facets of any cell of any
// mesh, to the measure times its curl.
TYPED_TEST(CoarseToFineTest, LinearPotentialsGiveTheirCurlOnEveryMesh) {
  constexpr int kDim = TypeParam::value;
  constexpr int kSize = MeshState<kDim>::kPotentialSize;
  const Eigen::MatrixXd slopes = Eigen::MatrixXd::Random(kSize, kDim);
  Vector<kDim> curl;
  if constexpr (kDim == 2) {
    curl << -slopes(0, 1), slopes(0, 0);
  } else {
    curl << slopes(2, 1) - slopes(1, 2), slopes(0, 2) - slopes(2, 0), slopes(1, 0) - slopes(0, 1);
  }
  for (const auto shape : {Shape::kBox, Shape::kRing}) {
    const Pair<kDim> meshes(shape);
    const auto& mesh = meshes.fine.mesh;
    MeshState<kDim> state;
    state.weights = SparseWeights(WeightMatrix::Zero(1, meshes.coarse.mesh.num_vertices()));
    state.potential.resize(1, kSize * meshes.coarse.topology.num_facets());
    for (Index f = 0; f < meshes.coarse.topology.num_facets(); ++f) {
      Vector<kDim> center = Vector<kDim>::Zero();
      for (int k = 0; k < kDim; ++k) {
        center += meshes.coarse.mesh.points.col(meshes.coarse.topology.facets(k, f)) / kDim;
      }
      state.potential.template middleCols<kSize>(kSize * f) = (slopes * center).transpose();
    }
    const Transfer<kDim> transfer(meshes.coarse, state, meshes.fine);
    for (Index s = 0; s < mesh.num_cells(); ++s) {
      Vector<kDim> sum = Vector<kDim>::Zero();
      for (int k = 0; k <= kDim; ++k) {
        const Index f = meshes.fine.topology.cell_facets(k, s);
        const double sign = meshes.fine.topology.sides(0, f) == s ? 1 : -1;
        sum += sign * transfer.facet_multiplier(f).row(0).transpose();
      }
      const double measure = signed_measure(mesh, s);
      // A potential's slope is a density, which does not depend on the scale.
      EXPECT_LT((sum - measure * curl).norm(), 1e-9 * measure);
    }
  }
}

// Transferred to the same mesh, a state is the state itself.
TYPED_TEST(CoarseToFineTest, TransferToTheSameMeshIsTheIdentity) {
  constexpr int kDim = TypeParam::value;
  for (const auto& sample : {make_sample<kDim>(Shape::kRing, 3, 0.2), make_hollow_sample<kDim>()}) {
    const auto problem = make_problem(sample.cage, sample.mesh, DistanceScheme::kSquare);
    const auto periods = gradient::boundary_periods(problem);
    const double penalty = 1000;
    gradient::GradientAdmm<double, kDim> admm(problem, penalty, 1.8, periods);
    admm.start_from_weights(harmonic_coordinates(problem));
    for (int k = 0; k < 30; ++k) admm.iterate();
    MeshState<kDim> state;
    state.penalty = penalty;
    state.weights = SparseWeights(integrate_least_squares(problem, admm.gradients()));
    const auto flux = admm.flux();
    const auto density_of = [&](Index s) -> Vectors<kDim> {
      return flux.cell(s).transpose() / signed_measure(problem.mesh, s);
    };
    state.flux_density = {problem.num_control_points(), problem.mesh.num_cells(), density_of};
    state.potential =
        flux_potential<kDim>(problem, [&](Index f) { return admm.facet_multiplier(f); });
    state.periods = admm.period_factors();
    const Transfer<kDim> transfer(problem, state, problem);

    EXPECT_LT((transfer.weights() - state.weights.dense()).cwiseAbs().maxCoeff(), 1e-12);
    gradient::GradientAdmm<double, kDim> other(problem, penalty, 1.8, periods);
    other.start_from_duals(
        transfer.weights(), [&](Index s) { return transfer.flux_density(s); },
        [&](Index f) { return transfer.facet_multiplier(f); }, transfer.periods());
    double largest = 0;
    double difference = 0;
    for (Index f = 0; f < problem.topology.num_facets(); ++f) {
      largest = std::max(largest, admm.facet_multiplier(f).norm());
      difference =
          std::max(difference, (other.facet_multiplier(f) - admm.facet_multiplier(f)).norm());
    }
    EXPECT_GT(largest, 0);
    EXPECT_LT(difference, 1e-10 * largest);
    // Kept in single precision.
    EXPECT_LT((transfer.flux_density(1) - density_of(1)).norm(), 1e-7 * density_of(1).norm());
    EXPECT_EQ(other.period_factors().cols(), static_cast<Eigen::Index>(periods.size()));
    EXPECT_LT((other.period_factors() - admm.period_factors()).norm(),
              1e-12 * admm.period_factors().norm() + 1e-300);
  }
}

// Started from the duals of its optimum, the splitting stays there.
TYPED_TEST(CoarseToFineTest, SplittingGoesOnFromItsOwnOptimum) {
  constexpr int kDim = TypeParam::value;
  const auto sample = make_sample<kDim>(Shape::kCorner, kDim == 2 ? 6 : 4, 0.2);
  const auto problem = make_problem(sample.cage, sample.mesh, DistanceScheme::kSquare);
  splitting::Metric metric;
  metric.cell.resize(problem.mesh.num_cells());
  for (Index s = 0; s < problem.mesh.num_cells(); ++s) {
    metric.cell[s] = signed_measure(problem.mesh, s);
  }
  metric.vertex = Eigen::VectorXd::Constant(problem.mesh.num_vertices(), metric.cell.mean() / 1000);
  compact::CompactSplitting<double, double, kDim> first(problem, metric, 8, 1.9);
  first.start_from_harmonic(8);
  for (int k = 0; k < 3000; ++k) first.iterate();
  Eigen::MatrixXd density(problem.num_control_points(), kDim * problem.mesh.num_cells());
  const auto flux = first.flux();
  for (Index s = 0; s < problem.mesh.num_cells(); ++s) {
    density.template middleCols<kDim>(kDim * s) = flux.cell(s).transpose() / metric.cell[s];
  }
  const WeightMatrix weights = first.weights();
  const VectorsAt<1> own_dual = [&](Index v) { return first.vertex_dual_at(v); };
  const auto moved = [&](const VectorsAt<kDim>& flux_density, const VectorsAt<1>& dual) {
    compact::CompactSplitting<double, double, kDim> second(problem, metric, 8, 1.9);
    second.start_from_duals([&](Index v) -> Eigen::VectorXd { return weights.col(v); },
                            flux_density, dual);
    EXPECT_LT((second.weights() - weights).cwiseAbs().maxCoeff(), 1e-14);
    double change = 0;
    for (int k = 0; k < 20; ++k) change += second.iterate().change;
    return change;
  };
  const VectorsAt<kDim> own = [&](Index s) {
    return density.template middleCols<kDim>(kDim * s).eval();
  };
  const VectorsAt<kDim> none = [&](Index) {
    return Vectors<kDim>::Zero(problem.num_control_points(), kDim).eval();
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
    // Where and as large as the cage given, whose first points are a frame.
    const double scale =
        bounding_box_diagonal(cage.points) / bounding_box_diagonal(sample.cage.points);
    const Vector<Dim> shift = cage.points.col(0) - scale * sample.cage.points.col(0);
    sample.mesh.points = (scale * sample.mesh.points).colwise() + shift;
    return sample.mesh;
  };
}

template <int Dim>
Sample<Dim> fine_sample() {
  return make_sample<Dim>(Shape::kCorner, Dim == 2 ? 26 : 6, 0.2);
}

template <int Dim>
CoarseLevels test_levels() {
  CoarseLevels levels;
  levels.coarsest = 50;
  levels.factor = 5;
  return levels;
}

TYPED_TEST(CoarseToFineTest, AgreesWithTheColdStartInFewerIterations) {
  constexpr int kDim = TypeParam::value;
  const auto sample = fine_sample<kDim>();
  const auto problem = make_problem(sample.cage, sample.mesh, DistanceScheme::kSquare);
  SolverOptions exact;
  exact.precision = Precision::kDouble;
  exact.tolerance = 1e-10;
  exact.certify = true;
  const auto optimum = solve(problem, exact);
  for (const auto method : {Method::kValue, Method::kGradient, Method::kLbc2014}) {
    SCOPED_TRACE(static_cast<int>(method));
    SolverOptions options;
    options.method = method;
    options.certify = true;
    // By default kLbc2014 asks for more than single precision has on meshes as small as these; and
    // where its tail is long, the start decides nothing.
    options.tolerance = method == Method::kValue ? 1e-6 : method == Method::kLbc2014 ? 1e-5 : 0;
    const auto cold = solve(problem, options);
    options.coarse_levels = test_levels<kDim>();
    const auto warm = solve(problem, options, sample_mesher<kDim>(Shape::kCorner));
    ASSERT_EQ(cold.report.status, SolveStatus::kConverged);
    ASSERT_EQ(warm.report.status, SolveStatus::kConverged);
    EXPECT_FALSE(warm.report.coarse_levels.empty());
    // kLbc2014 does not start from coarser meshes in 3D by default.
    if (kDim == 2 || method != Method::kLbc2014) {
      EXPECT_LT(warm.report.iterations, cold.report.iterations);
    }
    const auto error = [&](const Solution& solution) {
      return mean_squared_difference(sample.mesh, solution.weights, optimum.weights);
    };
    if (method == Method::kValue) {
      EXPECT_LT(error(warm), 3 * options.tolerance);
    } else {
      EXPECT_LT(error(warm), 2 * error(cold));
    }
    EXPECT_LT(mean_squared_difference(sample.mesh, warm.weights, cold.weights),
              method == Method::kValue ? options.tolerance : 2 * error(cold));
    EXPECT_LE(warm.report.certificate.lower_bound,
              optimum.report.certificate.objective * (1 + 1e-9));
    EXPECT_LT(warm.report.certificate.relative_gap, 0.2);
    const auto judgement = judge(sample.cage, sample.mesh, warm.weights);
    EXPECT_LT(judgement.partition_error, 1e-13);
    EXPECT_LT(judgement.reproduction_error, 1e-13);
    EXPECT_EQ(judgement.lagrange_error, 0);
  }
}

TYPED_TEST(CoarseToFineTest, ReportsEveryLevelAndCountsItsSeconds) {
  constexpr int kDim = TypeParam::value;
  const auto sample = fine_sample<kDim>();
  SolverOptions options;
  options.tolerance = 1e-5;
  options.check_interval = 1;
  options.coarse_levels = test_levels<kDim>();
  options.coarse_levels.factor = 3;
  std::vector<int> seen;
  options.progress = [&](const Progress& progress) {
    if (seen.empty() || seen.back() != progress.finer_levels) seen.push_back(progress.finer_levels);
    return true;
  };
  const auto solution =
      solve(sample.cage, sample.mesh, options, sample_mesher<kDim>(Shape::kCorner));
  const auto& report = solution.report;
  EXPECT_EQ(report.vertices, sample.mesh.num_vertices());
  ASSERT_GE(report.coarse_levels.size(), 2U);
  ASSERT_EQ(seen.size(), report.coarse_levels.size() + 1);
  Index below = 0;
  double seconds = 0;
  for (std::size_t k = 0; k < report.coarse_levels.size(); ++k) {
    const auto& level = report.coarse_levels[k];
    EXPECT_EQ(seen[k], static_cast<int>(report.coarse_levels.size() - k));
    EXPECT_GT(level.vertices, below);
    EXPECT_GT(level.cells, 0);
    EXPECT_GE(level.iterations, 8);
    EXPECT_GT(level.solve_seconds, 0);
    seconds += level.mesh_seconds + level.setup_seconds + level.solve_seconds;
    below = level.vertices;
  }
  EXPECT_LT(below, report.vertices);
  EXPECT_EQ(seen.back(), 0);
  EXPECT_GT(report.seconds.solve, seconds);
  EXPECT_GT(report.seconds.setup, 0);
}

// Without a usable coarse mesh the start is the ordinary one, to the bit.
TYPED_TEST(CoarseToFineTest, GoesOnWithoutALevelThatCannotBeHad) {
  constexpr int kDim = TypeParam::value;
  const auto sample = make_sample<kDim>(Shape::kCorner, kDim == 2 ? 12 : 6, 0.2);
  SolverOptions options;
  options.tolerance = 1e-5;
  options.coarse_levels = test_levels<kDim>();
  const auto cold = solve(sample.cage, sample.mesh, options);
  const CoarseMesher<kDim> meshers[] = {
      [](const Cage<kDim>&, Index) -> DomainMesh<kDim> { throw OptionError("too fine a cage"); },
      [](const Cage<kDim>&, Index) -> DomainMesh<kDim> { throw std::bad_function_call(); },
      [](const Cage<kDim>&, Index) { return DomainMesh<kDim>{}; },
      [&](const Cage<kDim>& cage, Index) {
        return sample_mesher<kDim>(Shape::kCorner)(cage, sample.mesh.num_vertices());
      }};
  for (const auto& mesher : meshers) {
    const auto warm = solve(sample.cage, sample.mesh, options, mesher);
    EXPECT_TRUE(warm.report.coarse_levels.empty());
    EXPECT_TRUE((warm.weights.array() == cold.weights.array()).all());
  }
}

TYPED_TEST(CoarseToFineTest, OtherMethodsStartAsEver) {
  constexpr int kDim = TypeParam::value;
  const auto sample = make_sample<kDim>(Shape::kCorner, 4, 0.2);
  int calls = 0;
  const CoarseMesher<kDim> mesher = [&](const Cage<kDim>& cage, Index vertices) {
    ++calls;
    return sample_mesher<kDim>(Shape::kCorner)(cage, vertices);
  };
  for (const auto method : {Method::kPaper, Method::kHarmonic}) {
    SolverOptions options;
    options.method = method;
    options.max_iterations = 30;
    options.coarse_levels.coarsest = 10;
    const auto plain = solve(sample.cage, sample.mesh, options);
    const auto same = solve(sample.cage, sample.mesh, options, mesher);
    EXPECT_TRUE((same.weights.array() == plain.weights.array()).all());
  }
  EXPECT_EQ(calls, 0);
}

TYPED_TEST(CoarseToFineTest, CanBeStoppedOnACoarseMesh) {
  constexpr int kDim = TypeParam::value;
  const auto sample = fine_sample<kDim>();
  SolverOptions options;
  options.coarse_levels = test_levels<kDim>();
  int calls = 0;
  options.progress = [&](const Progress& progress) {
    EXPECT_GT(progress.finer_levels, 0);
    return ++calls < 2;
  };
  const auto solution =
      solve(sample.cage, sample.mesh, options, sample_mesher<kDim>(Shape::kCorner));
  EXPECT_EQ(calls, 2);
  EXPECT_EQ(solution.report.status, SolveStatus::kStopped);
  EXPECT_EQ(solution.report.iterations, 1);
  EXPECT_LT(solution.report.quality.max_reproduction_error, 1e-13);
}

TYPED_TEST(CoarseToFineTest, ThreadsDoNotChangeABit) {
  constexpr int kDim = TypeParam::value;
  const auto sample = make_sample<kDim>(Shape::kCorner, kDim == 2 ? 14 : 6, 0.2);
  for (const auto method : {Method::kValue, Method::kGradient}) {
    SolverOptions options;
    options.method = method;
    options.tolerance = method == Method::kValue ? 1e-5 : 1e-3;
    options.coarse_levels = test_levels<kDim>();
    const auto run = [&](int threads) {
      options.threads = threads;
      return solve(sample.cage, sample.mesh, options, sample_mesher<kDim>(Shape::kCorner));
    };
    const auto one = run(1);
    const auto two = run(2);
    EXPECT_FALSE(one.report.coarse_levels.empty());
    EXPECT_EQ(one.report.iterations, two.report.iterations);
    EXPECT_TRUE((one.weights.array() == two.weights.array()).all());
  }
}

TYPED_TEST(CoarseToFineTest, RefusesAMeshOfSomethingElse) {
  constexpr int kDim = TypeParam::value;
  const auto sample = make_sample<kDim>(Shape::kCorner, kDim == 2 ? 12 : 6, 0.2);
  SolverOptions options;
  options.coarse_levels = test_levels<kDim>();
  const auto wrong = [](const Cage<kDim>&, Index) {
    return make_sample<kDim>(Shape::kStar, 3).mesh;
  };
  EXPECT_THROW(solve(sample.cage, sample.mesh, options, wrong), InputError);
}

// Asked for or not: on uses the mesher where it does not pay, off never does.
TYPED_TEST(CoarseToFineTest, IsOnOrOffAsAskedFor) {
  constexpr int kDim = TypeParam::value;
  const auto sample = make_sample<kDim>(Shape::kCorner, kDim == 2 ? 60 : 13, 0.2);
  ASSERT_GT(sample.mesh.num_vertices(), kDim == 2 ? 5000 : 2500);
  SolverOptions options;
  options.max_iterations = 20;
  const auto levels = [&](CoarseToFine choice) {
    options.coarse_to_fine = choice;
    return solve(sample.cage, sample.mesh, options, sample_mesher<kDim>(Shape::kCorner))
        .report.coarse_levels.size();
  };
  EXPECT_GT(levels(CoarseToFine::kOn), 0U);
  EXPECT_EQ(levels(CoarseToFine::kAuto), 0U);
  EXPECT_EQ(levels(CoarseToFine::kOff), 0U);
  options.coarse_levels = test_levels<kDim>();
  EXPECT_EQ(levels(CoarseToFine::kOff), 0U);
}

TEST(LevelSizes, NoneWhereTheyDoNotPay) {
  EXPECT_TRUE(level_sizes<2>(900, 30, Method::kGradient, false, {}).empty());
  EXPECT_TRUE(level_sizes<3>(6000, 50, Method::kGradient, false, {}).empty());
  EXPECT_TRUE(level_sizes<2>(5000, 30, Method::kValue, false, {}).empty());
  EXPECT_TRUE(level_sizes<2>(30000, 6, Method::kValue, false, {}).empty());
  EXPECT_TRUE(level_sizes<3>(6000, 50, Method::kValue, false, {}).empty());
  EXPECT_FALSE(level_sizes<3>(40000, 50, Method::kValue, false, {}).empty());
  EXPECT_FALSE(level_sizes<2>(10000, 30, Method::kValue, false, {}).empty());
  EXPECT_FALSE(level_sizes<2>(10000, 30, Method::kGradient, false, {}).empty());
  EXPECT_FALSE(level_sizes<3>(40000, 50, Method::kGradient, false, {}).empty());
  EXPECT_TRUE(level_sizes<3>(6000, 110, Method::kValue, false, {}).empty());
  EXPECT_FALSE(level_sizes<3>(6000, 110, Method::kValue, true, {}).empty());
}

TEST(LevelSizes, AscendByTheFactorDownToTheCoarsest) {
  CoarseLevels levels;
  levels.coarsest = 100;
  levels.factor = 10;
  EXPECT_EQ(level_sizes<2>(10000, 9, Method::kValue, false, levels),
            (std::vector<Index>{100, 1000}));
  EXPECT_EQ(level_sizes<3>(9999, 9, Method::kValue, false, levels), (std::vector<Index>{999}));
  EXPECT_TRUE(level_sizes<3>(999, 9, Method::kValue, false, levels).empty());
}

}  // namespace
}  // namespace flbc::testing
