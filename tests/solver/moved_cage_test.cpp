// SPDX-License-Identifier: BSD-3-Clause
// Editing a rest cage: the same optima as from scratch, for any path.
#include "flbc/report.h"
#include "support/refined_sample.h"
#include "support/solver_options.h"

namespace flbc::testing {
namespace {

constexpr double kTolerance = 1e-6;

template <int Dim>
Sample<Dim> sample_of(Shape shape = Shape::kCorner) {
  return make_sample<Dim>(shape, Dim == 2 ? 16 : 5, 0.2);
}

SolverOptions with_tolerance() {
  SolverOptions options;
  options.tolerance = kTolerance;
  return options;
}

// One control point moves by a part of the cage size, in a direction of no symmetry.
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

// Mean squared error of the weights of a solver: its distance to the optimum of its rest cage.
template <int Dim>
double error_of(const Solver<Dim>& solver) {
  const auto optimum = solve(solver.cage(), solver.mesh(), many_iterations(800));
  return mean_squared_difference(solver.mesh(), solver.solution().weights.dense(),
                                 optimum.weights.dense());
}

template <int Dim>
Solver<Dim> solved(const Sample<Dim>& sample, const SolverOptions& options = with_tolerance()) {
  Solver<Dim> solver(sample.cage, sample.mesh, options);
  solver.solve();
  return solver;
}

TEST_IN_2D_AND_3D(MovedCageTest, FindsTheOptimumOfTheMovedCageInFewerIterations) {
  for (const auto shape : {Shape::kCorner, Shape::kRing}) {
    const auto sample = sample_of<Dim>(shape);
    for (const auto& control_points :
         {with_one_moved(sample.cage, 0.002), with_one_moved(sample.cage, 0.03),
          bent(sample.cage, 0.005)}) {
      auto solver = solved(sample);
      const auto& warm = solver.reshape(control_points);
      const auto cold = solve(solver.cage(), solver.mesh(), with_tolerance());
      EXPECT_EQ(warm.report.status, SolveStatus::kConverged);
      EXPECT_LT(warm.report.iterations, cold.report.iterations);
      EXPECT_LT(error_of(solver), 3 * kTolerance);
      const auto judgement =
          expect_coordinates(solver.cage(), solver.mesh(), warm.weights.dense(), 1e-12);
      EXPECT_GE(judgement.min_weight, 0);
    }
  }
}

template <int Dim>
void expect_follows(Solver<Dim>& solver, const PointList<Dim>& control_points,
                    const WeightMatrix& weights) {
  solver.reshape(control_points);
  EXPECT_LT((solver.mesh().points - control_points * weights).cwiseAbs().maxCoeff(), 1e-13);
  EXPECT_TRUE(solver.cage().points == control_points);
}

// Whether or not that was solved explicitly.
TEST_IN_2D_AND_3D(MovedCageTest, TheMeshFollowsByTheWeightsOfTheFirstCage) {
  const auto sample = sample_of<Dim>();
  const WeightMatrix first = solve(sample.cage, sample.mesh, with_tolerance()).weights.dense();
  for (const bool solves : {false, true}) {
    Solver<Dim> solver(sample.cage, sample.mesh, with_tolerance());
    if (solves) solver.solve();
    expect_follows(solver, with_one_moved(sample.cage, 0.01, 1), first);
    expect_follows(solver, with_one_moved(sample.cage, 0.03), first);
  }
}

TEST(MovedCageTest, WhereCellsWouldBeInvertedTheMeshFollowsByThePresentWeights) {
  const auto sample = sample_of<3>();
  const auto far = with_one_moved(sample.cage, 0.63);
  auto solver = solved(sample);
  expect_refused("would be inverted", [&] { solver.reshape(far); });
  const auto near = with_one_moved(sample.cage, 0.55);
  solver.reshape(near);
  const WeightMatrix present = solver.solution().weights.dense();
  expect_follows<3>(solver, far, present);
  EXPECT_LT(error_of(solver), 3 * kTolerance);
  expect_follows<3>(solver, near, present);
}

TEST_IN_2D_AND_3D(MovedCageTest, ThereAndBackIsWhereItStarted) {
  const auto sample = sample_of<Dim>();
  auto solver = solved(sample);
  for (const double part : {0.01, 0.03, 0.02}) {
    solver.reshape(with_one_moved(sample.cage, part), {3});
  }
  EXPECT_EQ(solver.reshape(sample.cage.points).report.status, SolveStatus::kConverged);
  EXPECT_LT((solver.mesh().points - sample.mesh.points).cwiseAbs().maxCoeff(), 1e-13);
  EXPECT_LT(error_of(solver), 3 * kTolerance);
}

TEST_IN_2D_AND_3D(MovedCageTest, ABudgetEndsAStepAndSolvingResumes) {
  const auto sample = sample_of<Dim>();
  const auto control_points = with_one_moved(sample.cage, 0.03);
  auto at_once = solved(sample, many_iterations(60));
  at_once.reshape(control_points, {40});
  auto solver = solved(sample, many_iterations(60));
  const auto& solution = solver.reshape(control_points, {10});
  EXPECT_EQ(solution.report.status, SolveStatus::kIterationLimit);
  EXPECT_EQ(solution.report.iterations, 10);
  EXPECT_GE(solution.report.quality.min_weight, 0);
  EXPECT_LT(solution.report.quality.max_reproduction_error, 1e-13);
  for (int frame = 0; frame < 3; ++frame) solver.solve({10});
  EXPECT_TRUE(solver.solution().weights == at_once.solution().weights);
  const auto& shortest = solver.reshape(control_points, {0, 1e-9});  // seconds
  EXPECT_EQ(shortest.report.iterations, 1);
  EXPECT_LT(shortest.report.quality.max_reproduction_error, 1e-13);
  EXPECT_EQ(solver.reshape(control_points, {0, 1e9}).report.iterations, 60);
}

TEST_IN_2D_AND_3D(MovedCageTest, ACageThatIsRefusedChangesNothing) {
  const auto sample = sample_of<Dim>();
  const auto begin = [&] {
    auto solver = solved(sample);
    solver.reshape(with_one_moved(sample.cage, 0.01), {5});
    return solver;
  };
  auto solver = begin(), other = begin();
  // Through the opposite side of the cage.
  PointList<Dim> folded = sample.cage.points;
  const Vector<Dim> center = folded.rowwise().mean();
  folded.col(0) += 2.5 * (center - folded.col(0));
  try {
    solver.reshape(folded);
    FAIL() << "a cell was inverted";
  } catch (const InputError& error) {
    const std::string text = error.what();
    const auto number = text.find("cell ");
    ASSERT_NE(number, std::string::npos) << text;
    DomainMesh<Dim> mesh{folded * solve(sample.cage, sample.mesh, with_tolerance()).weights.dense(),
                         solver.mesh().cells};
    EXPECT_LE(signed_measure(mesh, std::stoi(text.substr(number + 5))), 0) << text;
    expect_piece(text, "(");
  }
  const PointList<Dim> fewer = sample.cage.points.leftCols(sample.cage.size() - 1);
  expect_error<InputError>([&] { solver.reshape(fewer); },
                           {std::to_string(fewer.cols()), std::to_string(sample.cage.size())});
  PointList<Dim> infinite = sample.cage.points;
  infinite(1, 2) = std::nan("");
  EXPECT_THROW(solver.reshape(infinite), InputError);
  EXPECT_THROW(solver.reshape(sample.cage.points, {-1}), OptionError);
  EXPECT_THROW(solver.solve({0, -1}), OptionError);
  EXPECT_THROW(solver.solve({0, std::nan("")}), OptionError);
  Observer fails;
  fails.progress = [](const Progress&) -> bool { throw std::runtime_error("no more"); };
  EXPECT_THROW(solver.reshape(bent(sample.cage, 0.02), {}, fails), std::runtime_error);

  EXPECT_TRUE(solver.mesh().points == other.mesh().points);
  EXPECT_TRUE(solver.cage().points == other.cage().points);
  EXPECT_TRUE(solver.solution().weights == other.solution().weights);
  EXPECT_TRUE(solver.solve({5}).weights == other.solve({5}).weights);
}

TEST_IN_2D_AND_3D(MovedCageTest, ThreadsDoNotChangeABit) {
  const auto sample = sample_of<Dim>();
  expect_same_for_any_threads([&] {
    auto solver = solved(sample);
    solver.reshape(bent(sample.cage, 0.01), {6});
    solver.solve({6});
    return solver.reshape(with_one_moved(sample.cage, 0.01)).weights.dense();
  });
}

TEST_IN_2D_AND_3D(MovedCageTest, DistancesComeFromACoarseMeshThatMovesAlong) {
  const auto sample = refined_sample<Dim>(Shape::kCorner, Dim == 2 ? 12 : 4);
  auto options = with_tolerance();
  options.distances = Distances::kInterpolated;
  auto solver = solved(sample, options);
  EXPECT_EQ(solver.solution().report.distances.source, Distances::kInterpolated);
  const auto expect_near_exact = [&](const Solution& solution) {
    const auto& distances = solution.report.distances;
    EXPECT_EQ(distances.source, Distances::kInterpolated);
    EXPECT_LT(distances.vertices, sample.mesh.num_vertices());
    EXPECT_GT(distances.phi_error, 0);
    EXPECT_LT(distances.phi_error, 0.05);
    EXPECT_LT(error_of(solver), 4e-6);
    const auto judgement =
        expect_coordinates(solver.cage(), solver.mesh(), solution.weights.dense(), 1e-12);
    EXPECT_GE(judgement.min_weight, 0);
  };
  expect_near_exact(solver.reshape(with_one_moved(sample.cage, 0.03)));
  expect_near_exact(solver.reshape(bent(sample.cage, 0.02)));
  PointList<Dim> turned = solver.cage().points;  // and grown: distances are those of the shape
  turned.row(0) = 3 * bent(sample.cage, 0.02).row(1);
  turned.row(1) = -3 * bent(sample.cage, 0.02).row(0);
  if (Dim == 3) turned.row(2) *= 3;
  expect_near_exact(solver.reshape(turned));
}

TEST_IN_2D_AND_3D(MovedCageTest, OtherMethodsStartOver) {
  const auto sample = make_sample<Dim>(Shape::kCorner, Dim == 2 ? 8 : 6, 0.2);
  for (const auto method : {Method::kGradient, Method::kPaper, Method::kLbc2014}) {
    SCOPED_TRACE(name_of(method));
    SolverOptions options{method};
    options.max_iterations = 100;
    auto solver = solved(sample, options);
    const auto& warm = solver.reshape(with_one_moved(sample.cage, 0.005));
    const auto cold = solve(solver.cage(), solver.mesh(), options);
    EXPECT_EQ(warm.report.iterations, cold.report.iterations);
    EXPECT_LT(mean_squared_difference(sample.mesh, warm.weights.dense(), cold.weights.dense()),
              1e-12);
  }
}

}  // namespace
}  // namespace flbc::testing
