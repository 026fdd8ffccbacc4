// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/cell_locator.h"
#include "flbc/harmonic.h"
#include "support/test.h"

namespace flbc::testing {
namespace {

// Points inside cells at known barycentric coordinates, several per cell.
template <int Dim>
PointList<Dim> points_in_cells(const DomainMesh<Dim>& mesh) {
  PointList<Dim> points(Dim, 2 * mesh.num_cells());
  for (Index p = 0; p < points.cols(); ++p) {
    Eigen::Matrix<double, Dim + 1, 1> share;
    for (int k = 0; k <= Dim; ++k) share[k] = 1.01 + std::sin(3.0 * p + k);
    share /= share.sum();
    points.col(p).setZero();
    for (int k = 0; k <= Dim; ++k)
      points.col(p) += share[k] * mesh.points.col(mesh.cells(k, p / 2));
  }
  return points;
}

TEST_IN_2D_AND_3D(CoordinatesTest, InterpolationKeepsLinearFunctionsAndTheConstraints) {
  for (const auto& sample : samples<Dim>()) {
    SCOPED_TRACE(sample.name);
    const auto problem = make_problem(sample.cage, sample.mesh, DistanceScheme::kConstant, 0);
    const auto weights = harmonic_coordinates(problem);
    const auto points = points_in_cells(problem.mesh);
    const auto places = locate_points(problem.mesh, points);
    for (Index p = 0; p < points.cols(); ++p) {
      EXPECT_EQ(places[p].cell, p / 2);
      EXPECT_NEAR(places[p].coordinates.sum(), 1, 1e-12);
    }
    const auto rows = interpolate(problem.mesh, weights, places).dense();
    const auto quality = measure_quality(problem.cage.points, points, rows);
    EXPECT_LT(quality.max_partition_error, 1e-12);
    EXPECT_LT(quality.max_reproduction_error, 1e-12);
  }
}

TEST_IN_2D_AND_3D(CoordinatesTest, VerticesAreFoundAndGiveTheirOwnWeights) {
  const auto sample = make_sample<Dim>(Shape::kRing, 4, 0.2);
  const WeightMatrix weights = WeightMatrix::Random(5, sample.mesh.num_vertices());
  const auto rows =
      interpolate(sample.mesh, weights, locate_points(sample.mesh, sample.mesh.points)).dense();
  EXPECT_LT((rows - weights).cwiseAbs().maxCoeff(), 1e-12);
}

TEST_IN_2D_AND_3D(CoordinatesTest, PointsOutsideAreCountedAndNamed) {
  const auto sample = make_sample<Dim>(Shape::kRing, 2);
  PointList<Dim> points(Dim, 4);
  points.col(0) = sample.mesh.points.col(0);
  points.col(1).setConstant(0.5);
  points.col(2).setConstant(0.5);
  points.col(2)[0] = points.col(2)[1] = 1.5;  // in the hole
  points.col(3).setConstant(100);
  expect_error<InputError>([&] { locate_points(sample.mesh, points); },
                           {"2 of 4 points are outside", "point 2 at (1.5, 1.5"});
  points.col(2).setConstant(0.5);
  points.col(3) = points.col(0).array() - 1e-8;  // as much outside as a file's rounding makes it
  EXPECT_NO_THROW(locate_points(sample.mesh, points));
}

TEST_IN_2D_AND_3D(CoordinatesTest, ObjectiveAgreesWithTheJudge) {
  const auto sample = make_sample<Dim>(Shape::kCorner, 3, 0.2);
  WeightMatrix weights = WeightMatrix::Random(sample.cage.size(), sample.mesh.num_vertices());
  const Eigen::MatrixXd phi =
      Eigen::MatrixXd::Random(sample.cage.size(), sample.mesh.num_cells()).cwiseAbs();
  const double expected = testing::objective(sample.mesh, weights, phi);
  EXPECT_NEAR(flbc::objective(sample.mesh, phi, weights), expected, 1e-12 * expected);
  EXPECT_THROW(measure_quality(sample.cage.points, sample.cage.points, weights), InputError);
}

}  // namespace
}  // namespace flbc::testing
