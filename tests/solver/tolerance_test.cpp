// SPDX-License-Identifier: BSD-3-Clause
// Whether the methods keep what their tolerance promises: on real cages, at any scale, on meshes of
// very different cells, in narrow gaps, and with few and many control points.
#include "mesh/cell_geometry.h"
#include "support/solver_options.h"

namespace flbc::testing {
namespace {

// What a true mean squared error may be, relative to the tolerance; at 1e-8 twice that and a
// little. Weights of round cages and boxes are nearly undetermined, so that they still creep when
// changes are small.
constexpr double kPromise = 1, kRoundPromise = 10, kGradientPromise = 5;

SolverOptions with_tolerance(double tolerance) {
  SolverOptions options;
  options.tolerance = tolerance;
  return options;
}

// The promise of kWeights, for the problem of default options.
template <int Dim>
void expect_promise_kept(const Cage<Dim>& cage, const DomainMesh<Dim>& mesh,
                         double promise = kPromise) {
  const auto problem = smooth_problem(Sample<Dim>{cage, mesh, ""});
  const auto exact = solve(problem, many_iterations(1500)).weights.dense();
  for (const double tolerance : {1e-4, 1e-5, 1e-6, 1e-7, 1e-8}) {
    SCOPED_TRACE(tolerance);
    const auto [weights, report] = solve(problem, with_tolerance(tolerance));
    EXPECT_EQ(report.status, SolveStatus::kConverged);
    EXPECT_EQ(report.criterion, Criterion::kTolerance);
    EXPECT_LT(mean_squared_difference(mesh, weights.dense(), exact),
              (tolerance < 1e-7 ? std::max(2.2, promise) : promise) * tolerance);
  }
}

// ---- scale --------------------------------------------------------------------------------------

TEST_IN_2D_AND_3D(ToleranceTest, IsTheSameAtEveryScalePlaceAndOrientation) {
  for (const auto shape : {Shape::kCorner, Shape::kRing}) {
    const auto sample = make_sample<Dim>(shape, Dim == 2 ? 12 : 4, 0.2);
    const double width = bounding_box_diagonal(sample.cage.points);
    auto options = with_tolerance(1e-7);
    options.certify = true;
    const auto expected = solve(sample.cage, sample.mesh, options);
    for (const double size : {0.001, 0.03, 7.0, 1000.0}) {
      SCOPED_TRACE(sample.name + ", size " + std::to_string(size));
      auto moved = sample;
      for (auto* points : {&moved.cage.points, &moved.mesh.points}) {
        *points = (size / width * *points).colwise() + Vector<Dim>::Constant(3 * size);
      }
      const auto solution = solve(reversed(moved.cage), moved.mesh, options);
      EXPECT_EQ(solution.report.iterations, expected.report.iterations);
      EXPECT_LT(
          mean_squared_difference(sample.mesh, solution.weights.dense(), expected.weights.dense()),
          1e-11);
      EXPECT_NEAR(solution.report.certificate.relative_gap,
                  expected.report.certificate.relative_gap, 1e-3);
      const double enlargement = std::pow(size / width, Dim - 1);
      EXPECT_NEAR(solution.report.objective, enlargement * expected.report.objective,
                  1e-4 * solution.report.objective);
    }
  }
}

// ---- meshes and cages that are hard -------------------------------------------------------------

// A box that is meshed the finer the nearer to one corner: distances r from it, in the maximum
// norm, become r^power. \param ratio  between the sizes of the largest and the smallest cells
template <int Dim>
Sample<Dim> graded_box(Index subdivisions, double ratio) {
  auto sample = make_sample<Dim>(Shape::kBox, subdivisions);
  const double power = 1 + std::log(ratio) / std::log(subdivisions);
  for (Index v = 0; v < sample.mesh.num_vertices(); ++v) {
    const double distance = sample.mesh.points.col(v).template lpNorm<Eigen::Infinity>();
    if (distance > 0) sample.mesh.points.col(v) *= std::pow(distance, power - 1);
  }
  return sample;
}

TEST_IN_2D_AND_3D(ToleranceTest, HoldsOnMeshesGradedByAFactorOfAHundred) {
  const auto sample = graded_box<Dim>(Dim == 2 ? 24 : 8, 100);
  const Eigen::VectorXd sizes = cell_measures(sample.mesh).array().pow(1.0 / Dim);
  ASSERT_GT(sizes.maxCoeff(), 100 * sizes.minCoeff());
  expect_promise_kept(sample.cage, sample.mesh, kRoundPromise);
}

TEST(Tolerance2dTest, HoldsOnRegularPolygonsAndStars) {
  for (const Index corners : {4, 15, 60}) {
    SCOPED_TRACE(corners);
    const auto cage = regular_polygon(corners);
    expect_promise_kept(cage, mesh_of(cage, 800), kRoundPromise);
  }
  const auto spikes = regular_polygon(48, 0.3);
  expect_promise_kept(spikes, mesh_of(spikes, 1500));
}

TEST(Tolerance3dTest, HoldsOnRoundCages) {
  for (const Index k : {1, 3}) {
    const auto cage = round_cage(k);
    SCOPED_TRACE(cage.size());
    expect_promise_kept(cage, mesh_of(cage, 800), kRoundPromise);
  }
}

// Weights on both sides of a narrow gap hardly know of each other, and converge slowly.
TEST(Tolerance2dTest, HoldsInNarrowGaps) {
  const auto slit =
      loop(PointList<2>{{0, 4, 4, 1, 1, 4, 4, 0}, {0, 0, 1.95, 1.95, 2.05, 2.05, 4, 4}});
  expect_promise_kept(slit, mesh_of(slit, 3000));
  std::vector<Eigen::Vector2d> corners{{0, 0}, {8, 0}};
  for (double k = 8; k >= 2; --k) {
    corners.insert(corners.end(), {{k, 3}, {k - 0.45, 3}, {k - 0.45, 0.6}, {k - 0.55, 0.6}});
  }
  corners.insert(corners.end(), {{1, 3}, {0, 3}});
  const auto comb =
      loop(Eigen::Map<PointList<2>>(corners[0].data(), 2, static_cast<Index>(corners.size())));
  expect_promise_kept(comb, mesh_of(comb, 3000));
}

// ---- limits -------------------------------------------------------------------------------------

// Rounding ends all progress at some error, which single precision keeps small.
TEST_IN_2D_AND_3D(ToleranceTest, OfTinyErrorsIsAsFarAsSinglePrecisionGoes) {
  const auto sample = make_sample<Dim>(Shape::kCorner, Dim == 2 ? 12 : 4, 0.2);
  const auto problem = smooth_problem(sample);
  const auto exact = solve(problem, many_iterations(1500)).weights.dense();
  for (const double tolerance : {1e-11, 1e-13, 1e-15}) {
    auto options = with_tolerance(tolerance);
    options.max_iterations = 1500;
    const auto weights = solve(problem, options).weights.dense();
    EXPECT_LT(mean_squared_difference(sample.mesh, weights, exact), 1e-8) << tolerance;
  }
}

// As many control points as make the weights unique: no iteration can go wrong.
TEST_IN_2D_AND_3D(ToleranceTest, ASimplexHasItsBarycentricCoordinates) {
  const auto sample = make_sample<Dim>(Shape::kSimplex, 6, 0.2);
  const auto solution = solve(sample.cage, sample.mesh, with_tolerance(1e-8));
  EXPECT_EQ(solution.report.status, SolveStatus::kConverged);
  const auto expected = barycentric_coordinates<Dim>(sample.cage.points, sample.mesh.points);
  EXPECT_LT((solution.weights.dense() - expected).cwiseAbs().maxCoeff(), 1e-12);
}

// Without smoothness, a tolerance only estimates the error, so the run that it ends reports how far
// the objective may be off.
TEST_IN_2D_AND_3D(ToleranceTest, WithoutSmoothnessARunEndsWithACertificate) {
  const auto sample = make_sample<Dim>(Shape::kCorner, Dim == 2 ? 12 : 4, 0.2);
  auto options = with_tolerance(1e-5);
  const auto smooth = solve(sample.cage, sample.mesh, options).report;
  EXPECT_EQ(smooth.criterion, Criterion::kTolerance);
  EXPECT_EQ(smooth.certificate.objective, 0);  // none: the weights are unique and estimated well
  options.smoothness = 0;
  const auto plain = solve(sample.cage, sample.mesh, options).report;
  options.certify = true;
  const auto asked = solve(sample.cage, sample.mesh, options).report;
  EXPECT_EQ(plain.criterion, Criterion::kTolerance);
  EXPECT_EQ(plain.iterations, asked.iterations);
  EXPECT_GT(plain.certificate.relative_gap, 0);
  EXPECT_EQ(plain.certificate.relative_gap, asked.certificate.relative_gap);
  EXPECT_EQ(plain.certificate.proof, nullptr);  // which would take memory
}

// ---- kGradient ----------------------------------------------------------------------------------

// The error is that to the optimum without non-negativity, which kWeights finds by another
// iteration.
template <int Dim>
void expect_gradient_promise_kept(const LbcProblem<Dim>& problem,
                                  const std::vector<double>& tolerances) {
  SolverOptions options;
  options.non_negative = NonNegative::kOff;
  const auto exact = solve(problem, many_iterations(1500, options)).weights.dense();
  options.method = Method::kGradient;
  for (const double tolerance : tolerances) {
    SCOPED_TRACE(tolerance);
    options.tolerance = tolerance;
    const auto [weights, report] = solve(problem, options);
    EXPECT_EQ(report.status, SolveStatus::kConverged);
    EXPECT_LT(mean_squared_difference(problem.mesh, weights.dense(), exact),
              kGradientPromise * tolerance);
  }
}

// The ring has a hole, which adds period constraints.
TEST_IN_2D_AND_3D(GradientToleranceTest, HoldsOnSamples) {
  for (const auto shape : {Shape::kCorner, Shape::kRing}) {
    const auto sample = make_sample<Dim>(shape, Dim == 2 ? 12 : 4, 0.2);
    SCOPED_TRACE(sample.name);
    expect_gradient_promise_kept(smooth_problem(sample), {1e-4, 1e-5, 1e-6});
  }
}

// ---- real cages ---------------------------------------------------------------------------------

template <int Dim>
void expect_promises_kept_on(const Model& model) {
  if (!has_model(model.file)) GTEST_SKIP() << "the real models are absent";
  const auto cage = load_cage<Dim>(model.file);
  const auto mesh = mesh_of(cage, model.vertices);
  expect_promise_kept(cage, mesh);
  if constexpr (Dim == 2) {  // in 3D, finer tolerances take thousands of iterations
    expect_gradient_promise_kept(smooth_problem(Sample<Dim>{cage, mesh, ""}), {1e-4, 1e-5, 1e-6});
  }
}

class LongTolerance : public ::testing::TestWithParam<Model> {};
TEST_P(LongTolerance, Holds) {
  GetParam().is_planar() ? expect_promises_kept_on<2>(GetParam())
                         : expect_promises_kept_on<3>(GetParam());
}
INSTANTIATE_TEST_SUITE_P(Models, LongTolerance,
                         ::testing::Values(Model{"woody", "2d/woody-control-edgeset.obj", 2000},
                                           Model{"cactus", "2d/cactus-control-edgeset.obj", 2000},
                                           Model{"logo", "2d/LBClogo-control-edgeset.obj", 2000},
                                           Model{"horse", "3d/horse_cage.obj", 2000},
                                           Model{"shark", "3d/shark_cage.obj", 2000},
                                           Model{"beast", "3d/beast_cage.obj", 2000},
                                           Model{"arm", "3d/arm_cage.obj", 950}),
                         name_of_model);

// From cage to coordinates: every documented property, measured independently.
template <int Dim>
void expect_properties(const Model& model) {
  if (!has_model(model.file)) GTEST_SKIP() << "the real models are absent";
  const auto cage = load_cage<Dim>(model.file);
  const auto mesh = mesh_of(cage, model.vertices);
  EXPECT_NEAR(mesh.num_vertices(), model.vertices, (Dim == 2 ? 0.05 : 0.1) * model.vertices);
  auto options = without_smoothness();
  options.certify = true;
  const auto plain = solve(cage, mesh, options).report;
  EXPECT_EQ(plain.criterion, Criterion::kGap);
  EXPECT_LE(plain.certificate.relative_gap, 1e-3);
  const auto solution = solve(cage, mesh);
  EXPECT_EQ(solution.report.criterion, Criterion::kTolerance);
  EXPECT_GT(solution.report.objective, plain.certificate.lower_bound);
  const auto judgement = judge(cage, mesh, solution.weights.dense());
  EXPECT_LT(judgement.partition_error, 1e-12);
  // TetGen points on facets are off by up to 1e-9 of cage size.
  EXPECT_LT(judgement.reproduction_error, Dim == 2 ? 1e-12 : 1e-8);
  EXPECT_EQ(judgement.lagrange_error, 0);
  EXPECT_LT(judgement.linearity_error, 1e-9);
  EXPECT_EQ(judgement.control_points_found, cage.size());
  EXPECT_EQ(judgement.boundary_vertices_off_cage, 0);
  EXPECT_GE(judgement.min_weight, 0);
  // Locality: few control points influence a vertex, for any number of control points.
  EXPECT_LT(solution.report.quality.mean_influences, 8.5);
}

class RealModels : public ::testing::TestWithParam<Model> {};
TEST_P(RealModels, DefaultTolerance) {
  GetParam().is_planar() ? expect_properties<2>(GetParam()) : expect_properties<3>(GetParam());
}
INSTANTIATE_TEST_SUITE_P(Paper, RealModels,
                         ::testing::Values(Model{"woody", "2d/woody-control-edgeset.obj", 10800},
                                           Model{"cactus", "2d/cactus-control-edgeset.obj", 10800},
                                           Model{"logo", "2d/LBClogo-control-edgeset.obj", 26800},
                                           Model{"horse", "3d/horse_cage.obj", 5900},
                                           Model{"armadillo", "3d/armadillo_cage.obj", 6600}),
                         name_of_model);

}  // namespace
}  // namespace flbc::testing
