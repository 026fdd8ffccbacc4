// SPDX-License-Identifier: BSD-3-Clause
// Editing a rest cage: the same optima as from scratch, in fewer iterations, for any path.
#include "flbc/solver.h"

#include "support/coarse_sample_mesher.h"
#include "support/many_iterations.h"
#include "support/test.h"

namespace flbc::testing {
namespace {

constexpr double kTolerance = 1e-7;

template <int Dim>
Sample<Dim> sample_of(Shape shape = Shape::kCorner) {
  return make_sample<Dim>(shape, Dim == 2 ? 16 : 5, 0.2);
}

SolverOptions tight() {
  SolverOptions options;
  options.tolerance = kTolerance;
  return options;
}

// One control point moves by a part of the cage's size, in a direction of no symmetry.
template <int Dim>
PointList<Dim> with_one_moved(const Cage<Dim>& cage, double part, Index point = 2) {
  PointList<Dim> moved = cage.points;
  moved.col(point) +=
      part * bounding_box_diagonal(cage.points) * Vector<Dim>::LinSpaced(0.9, 0.3).normalized();
  return moved;
}

// All of them: a bend.
template <int Dim>
PointList<Dim> bent(const Cage<Dim>& cage, double part) {
  PointList<Dim> moved = cage.points;
  const double size = bounding_box_diagonal(cage.points);
  moved.row(1).array() += part * size * (4 / size * cage.points.row(0).array()).sin();
  return moved;
}

template <int Dim>
WeightMatrix optimum(const Solver<Dim>& coordinates) {
  return solve(coordinates.cage(), coordinates.mesh(), many_iterations(2000)).weights.dense();
}

TEST_IN_2D_AND_3D(MovedCageTest, FindsTheOptimumOfTheMovedCageInFewerIterations) {
  for (const auto shape : {Shape::kCorner, Shape::kRing}) {
    const auto sample = sample_of<Dim>(shape);
    for (const auto& control_points :
         {with_one_moved(sample.cage, 0.002), with_one_moved(sample.cage, 0.03),
          bent(sample.cage, 0.005)}) {
      Solver<Dim> coordinates(sample.cage, sample.mesh, tight());
      coordinates.solve();
      const auto warm = coordinates.move(control_points);
      const auto cold = solve(coordinates.cage(), coordinates.mesh(), tight());
      EXPECT_EQ(warm.report.status, SolveStatus::kConverged);
      EXPECT_LT(warm.report.iterations, cold.report.iterations);
      const auto exact = optimum(coordinates);
      const auto& mesh = coordinates.mesh();
      EXPECT_LT(mean_squared_difference(mesh, warm.weights.dense(), exact), 3 * kTolerance);
      const auto judgement = judge(coordinates.cage(), mesh, warm.weights.dense());
      EXPECT_LT(judgement.partition_error, 1e-12);
      EXPECT_LT(judgement.reproduction_error, 1e-12);
      EXPECT_EQ(judgement.lagrange_error, 0);
      EXPECT_LT(judgement.linearity_error, 1e-11);
      EXPECT_EQ(judgement.boundary_vertices_off_cage, 0);
      EXPECT_GE(judgement.min_weight, 0);
    }
  }
}

TEST_IN_2D_AND_3D(MovedCageTest, TheMeshFollowsByTheFirstWeights) {
  const auto sample = sample_of<Dim>();
  Solver<Dim> coordinates(sample.cage, sample.mesh, tight());
  coordinates.solve();
  const WeightMatrix first = coordinates.solution().weights.dense();
  coordinates.move(with_one_moved(sample.cage, 0.01, 1));
  const auto control_points = with_one_moved(sample.cage, 0.02);
  coordinates.move(control_points);
  EXPECT_LT((coordinates.mesh().points - control_points * first).cwiseAbs().maxCoeff(), 1e-13);
  EXPECT_TRUE(coordinates.cage().points == control_points);
}

TEST_IN_2D_AND_3D(MovedCageTest, ThereAndBackIsWhereItStarted) {
  const auto sample = sample_of<Dim>();
  Solver<Dim> coordinates(sample.cage, sample.mesh, tight());
  coordinates.solve();
  const auto exact = optimum(coordinates);
  for (const double part : {0.01, 0.02, 0.03, 0.02, 0.01}) {
    coordinates.move(with_one_moved(sample.cage, part), {3, 0});
  }
  const auto back = coordinates.move(sample.cage.points);
  EXPECT_LT((coordinates.mesh().points - sample.mesh.points).cwiseAbs().maxCoeff(), 1e-13);
  EXPECT_EQ(back.report.status, SolveStatus::kConverged);
  EXPECT_LT(mean_squared_difference(sample.mesh, back.weights.dense(), exact), 3 * kTolerance);
}

TEST_IN_2D_AND_3D(MovedCageTest, AfterAnchoringTheMeshFollowsByThePresentWeights) {
  const auto sample = sample_of<Dim>();
  Solver<Dim> coordinates(sample.cage, sample.mesh);
  coordinates.solve();
  coordinates.move(with_one_moved(sample.cage, 0.03));
  const auto before = coordinates.mesh().points;
  const WeightMatrix weights = coordinates.solution().weights.dense();
  coordinates.anchor();
  EXPECT_TRUE(coordinates.mesh().points == before);
  const auto control_points = with_one_moved(sample.cage, 0.06);
  coordinates.move(control_points);
  EXPECT_LT((coordinates.mesh().points - control_points * weights).cwiseAbs().maxCoeff(), 1e-13);
}

TEST_IN_2D_AND_3D(MovedCageTest, ABudgetEndsAStepAndRefiningGoesOn) {
  const auto sample = sample_of<Dim>();
  const auto control_points = with_one_moved(sample.cage, 0.03);
  auto endless = tight();
  endless.tolerance = 1e-30;
  endless.max_iterations = 60;
  Solver<Dim> at_once(sample.cage, sample.mesh, endless);
  at_once.solve();
  at_once.move(control_points, {40, 0});
  Solver<Dim> coordinates(sample.cage, sample.mesh, endless);
  coordinates.solve();
  const auto& solution = coordinates.move(control_points, {10, 0});
  EXPECT_EQ(solution.report.status, SolveStatus::kIterationLimit);
  EXPECT_EQ(solution.report.iterations, 10);
  EXPECT_GE(solution.report.quality.min_weight, 0);
  EXPECT_LT(solution.report.quality.max_reproduction_error, 1e-13);
  for (int frame = 0; frame < 3; ++frame) coordinates.solve({10, 0});
  EXPECT_TRUE(coordinates.solution().weights.dense() ==
              at_once.solution().weights.dense());  // bit-identical

  Solver<Dim> released(sample.cage, sample.mesh, tight());
  released.solve();
  EXPECT_EQ(released.move(control_points, {5, 0}).report.iterations, 5);
  const auto& refined = released.solve();
  EXPECT_EQ(refined.report.status, SolveStatus::kConverged);
  EXPECT_LT(mean_squared_difference(released.mesh(), refined.weights.dense(), optimum(released)),
            3 * kTolerance);
}

TEST_IN_2D_AND_3D(MovedCageTest, ABudgetOfTimeLeavesUsableWeights) {
  const auto sample = sample_of<Dim>();
  int calls = 0;
  auto options = tight();
  options.tolerance = 1e-30;  // never
  options.max_iterations = 60;
  Observer observer;
  observer.progress = [&](const Progress& progress) {
    EXPECT_EQ(progress.iteration % 10, 0);
    ++calls;
    return true;
  };
  Solver<Dim> coordinates(sample.cage, sample.mesh, options);
  coordinates.solve();
  const auto& shortest = coordinates.move(with_one_moved(sample.cage, 0.01), {0, 1e-9}, observer);
  EXPECT_EQ(shortest.report.status, SolveStatus::kIterationLimit);
  EXPECT_EQ(shortest.report.iterations, 1);
  EXPECT_EQ(calls, 0);
  EXPECT_LT(shortest.report.quality.max_reproduction_error, 1e-13);
  const auto& longest = coordinates.move(with_one_moved(sample.cage, 0.02), {0, 1e9}, observer);
  EXPECT_EQ(longest.report.iterations, 60);
  EXPECT_EQ(calls, 5);
}

TEST_IN_2D_AND_3D(MovedCageTest, RefusesFoldsAndStaysAsItWas) {
  const auto sample = sample_of<Dim>();
  Solver<Dim> coordinates(sample.cage, sample.mesh, tight());
  coordinates.solve();
  coordinates.move(with_one_moved(sample.cage, 0.01), {5, 0});
  const auto points = coordinates.mesh().points;
  const WeightMatrix weights = coordinates.solution().weights.dense();
  // Through the opposite side of the cage.
  PointList<Dim> folded = sample.cage.points;
  const Vector<Dim> center = folded.rowwise().mean();
  folded.col(0) += 2.5 * (center - folded.col(0));
  try {
    coordinates.move(folded);
    FAIL() << "a cell was turned over";
  } catch (const InputError& error) {
    const std::string text = error.what();
    const auto number = text.find("cell ");
    ASSERT_NE(number, std::string::npos) << text;
    const int cell = std::stoi(text.substr(number + 5));
    // Indeed turned over.
    DomainMesh<Dim> mesh{folded * solve(sample.cage, sample.mesh, tight()).weights.dense(),
                         coordinates.mesh().cells};
    EXPECT_LE(signed_measure(mesh, cell), 0) << text;
    EXPECT_NE(text.find('('), std::string::npos) << text;
  }
  EXPECT_TRUE(coordinates.mesh().points == points);
  EXPECT_TRUE(coordinates.cage().points == with_one_moved(sample.cage, 0.01));
  EXPECT_TRUE(coordinates.solution().weights.dense() == weights);
  // Then it continues normally.
  Solver<Dim> other(sample.cage, sample.mesh, tight());
  other.solve();
  other.move(with_one_moved(sample.cage, 0.01), {5, 0});
  EXPECT_TRUE(coordinates.solve({5, 0}).weights.dense() == other.solve({5, 0}).weights.dense());
}

TEST_IN_2D_AND_3D(MovedCageTest, RefusesWhatIsNoCageByName) {
  const auto sample = sample_of<Dim>();
  Solver<Dim> coordinates(sample.cage, sample.mesh);
  coordinates.solve();
  const PointList<Dim> fewer = sample.cage.points.leftCols(sample.cage.size() - 1);
  expect_error<InputError>([&] { coordinates.move(fewer); },
                           {std::to_string(fewer.cols()), std::to_string(sample.cage.size())});
  PointList<Dim> infinite = sample.cage.points;
  infinite(1, 2) = std::nan("");
  EXPECT_THROW(coordinates.move(infinite), InputError);
  EXPECT_THROW(coordinates.move(sample.cage.points, {-1, 0}), OptionError);
  EXPECT_THROW(coordinates.solve({0, -1}), OptionError);
  EXPECT_THROW(coordinates.solve({0, std::nan("")}), OptionError);
  EXPECT_TRUE(coordinates.mesh().points == sample.mesh.points);
}

// A callback that throws is the only way in which a solve fails in the middle here.
TEST_IN_2D_AND_3D(MovedCageTest, SurvivesASolveThatFails) {
  const auto sample = sample_of<Dim>();
  Observer fails;
  fails.progress = [](const Progress&) -> bool { throw std::runtime_error("no more"); };
  Solver<Dim> coordinates(sample.cage, sample.mesh, tight());
  coordinates.solve();
  const WeightMatrix weights = coordinates.solution().weights.dense();
  EXPECT_THROW(coordinates.move(bent(sample.cage, 0.02), {}, fails), std::runtime_error);
  EXPECT_TRUE(coordinates.solution().weights.dense() == weights);
  EXPECT_TRUE(coordinates.mesh().points == sample.mesh.points);
  const auto refined = coordinates.solve();
  EXPECT_LT(mean_squared_difference(sample.mesh, refined.weights.dense(), optimum(coordinates)),
            3 * kTolerance);
}

TEST_IN_2D_AND_3D(MovedCageTest, ThreadsDoNotChangeABit) {
  const auto sample = sample_of<Dim>();
  const auto result = [&](int threads) {
    auto options = tight();
    options.threads = threads;
    Solver<Dim> coordinates(sample.cage, sample.mesh, options);
    coordinates.solve();
    coordinates.move(bent(sample.cage, 0.01), {6, 0});
    coordinates.solve({6, 0});
    return WeightMatrix(coordinates.move(with_one_moved(sample.cage, 0.01)).weights.dense());
  };
  const auto one = result(1);
  EXPECT_TRUE(result(2) == one);
  EXPECT_TRUE(result(4) == one);
}

TEST_IN_2D_AND_3D(MovedCageTest, FollowsOnSupports) {
  const auto sample = sample_of<Dim>();
  auto options = tight();
  options.active_set = ActiveSet::kOn;
  options.gap = 0;
  Solver<Dim> coordinates(sample.cage, sample.mesh, options);
  coordinates.solve();
  EXPECT_TRUE(coordinates.solution().weights.dense() ==
              solve(sample.cage, sample.mesh, options).weights.dense());  // bit-identical
  for (const double part : {0.004, 0.01}) {
    const auto warm = coordinates.move(with_one_moved(sample.cage, part));
    const auto cold = solve(coordinates.cage(), coordinates.mesh(), options);
    EXPECT_LT(warm.report.active_set.density, 1);
    EXPECT_EQ(warm.report.status, SolveStatus::kConverged);
    EXPECT_LT(warm.report.iterations, cold.report.iterations);
    EXPECT_LT(mean_squared_difference(sample.mesh, warm.weights.dense(), optimum(coordinates)),
              3 * kTolerance);
  }
  coordinates.move(with_one_moved(sample.cage, 0.02), {3, 0});
  const auto& refined = coordinates.solve();
  EXPECT_LT(mean_squared_difference(sample.mesh, refined.weights.dense(), optimum(coordinates)),
            3 * kTolerance);
  EXPECT_GE(refined.report.quality.min_weight, 0);
}

TEST_IN_2D_AND_3D(MovedCageTest, DistancesComeFromACoarseMeshThatMovesAlong) {
  const auto sample = make_sample<Dim>(Shape::kCorner, Dim == 2 ? 24 : 8, 0.2);
  auto options = tight();
  options.distances = Distances::kInterpolated;
  Solver<Dim> coordinates(sample.cage, sample.mesh, options,
                          coarse_sample_mesher<Dim>(Dim == 2 ? 8 : 4));
  coordinates.solve();
  EXPECT_EQ(coordinates.solution().report.distances.source, Distances::kInterpolated);
  const auto expect_near_exact = [&](const Solution& solution) {
    const auto& distances = solution.report.distances;
    EXPECT_EQ(distances.source, Distances::kInterpolated);
    EXPECT_LT(distances.vertices, sample.mesh.num_vertices());
    EXPECT_GT(distances.phi_error, 0);
    EXPECT_LT(distances.phi_error, 0.05);
    const auto exact = optimum(coordinates);
    EXPECT_LT(mean_squared_difference(coordinates.mesh(), solution.weights.dense(), exact), 2e-6);
    const auto judgement = judge(coordinates.cage(), coordinates.mesh(), solution.weights.dense());
    EXPECT_LT(judgement.reproduction_error, 1e-12);
    EXPECT_GE(judgement.min_weight, 0);
  };
  expect_near_exact(coordinates.move(with_one_moved(sample.cage, 0.03)));
  coordinates.anchor();
  expect_near_exact(coordinates.move(bent(sample.cage, 0.02)));
  PointList<Dim> turned = coordinates.cage().points;  // and grown: distances are of the shape
  turned.row(0) = 3 * bent(sample.cage, 0.02).row(1);
  turned.row(1) = -3 * bent(sample.cage, 0.02).row(0);
  if (Dim == 3) turned.row(2) *= 3;
  expect_near_exact(coordinates.move(turned));
}

// A coarse mesh of another cage is not used for interpolation; distances are then exact.
TEST_IN_2D_AND_3D(MovedCageTest, WithoutACoarseMeshDistancesAreExact) {
  const auto sample = sample_of<Dim>();
  const CoarseMesher<Dim> fails = [](const Cage<Dim>&, Index) -> DomainMesh<Dim> {
    throw InputError("no mesh");
  };
  Solver<Dim> plain(sample.cage, sample.mesh, tight());
  plain.solve();
  Solver<Dim> coordinates(sample.cage, sample.mesh, tight(), fails);
  coordinates.solve();
  const auto control_points = with_one_moved(sample.cage, 0.01);
  const auto& solution = coordinates.move(control_points);
  EXPECT_EQ(solution.report.distances.source, Distances::kExact);
  EXPECT_TRUE(solution.weights.dense() == plain.move(control_points).weights.dense());

  auto interpolated = tight();
  interpolated.distances = Distances::kInterpolated;
  EXPECT_THROW(Solver<Dim>(sample.cage, sample.mesh, interpolated), OptionError);
}

// Other methods start over.
TEST_IN_2D_AND_3D(MovedCageTest, EveryMethodFollows) {
  const auto sample = make_sample<Dim>(Shape::kCorner, Dim == 2 ? 8 : 6, 0.2);
  for (const auto method : {Method::kGradient, Method::kPaper, Method::kLbc2014}) {
    SCOPED_TRACE(static_cast<int>(method));
    SolverOptions options;
    options.method = method;
    options.max_iterations = 3000;
    if (method == Method::kGradient) options.tolerance = 1e-4;
    Solver<Dim> coordinates(sample.cage, sample.mesh, options);
    coordinates.solve();
    const auto warm = coordinates.move(with_one_moved(sample.cage, 0.005));
    const auto cold = solve(coordinates.cage(), coordinates.mesh(), options);
    EXPECT_EQ(warm.report.iterations, cold.report.iterations);
    EXPECT_LT(mean_squared_difference(sample.mesh, warm.weights.dense(), cold.weights.dense()),
              1e-12);
  }
}

}  // namespace
}  // namespace flbc::testing
