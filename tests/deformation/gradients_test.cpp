// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/gradients.h"

#include "flbc/cell_locator.h"
#include "flbc/harmonic.h"
#include "mesh/cell_geometry.h"
#include "support/test.h"

namespace flbc::testing {
namespace {

template <int Dim>
using Square = Eigen::Matrix<double, Dim, Dim>;

template <int Dim>
Square<Dim> at(const Eigen::MatrixXd& jacobians, Eigen::Index p) {
  return jacobians.col(p).reshaped(Dim, Dim);
}

// Not symmetric, so that a transposed result is noticed.
template <int Dim>
Square<Dim> linear_part() {
  Square<Dim> a = 2 * Square<Dim>::Identity();
  a(0, 1) = 0.5;
  a(1, 0) = -0.25;
  return a;
}

TEST_IN_2D_AND_3D(GradientsTest, AffinePosesGiveTheirLinearPart) {
  for (const auto& sample : samples<Dim>()) {
    SCOPED_TRACE(sample.name);
    const auto problem = make_problem(sample.cage, sample.mesh, DistanceScheme::kConstant, 0);
    const auto weights = harmonic_coordinates(problem);
    const PointList<Dim> points = centroids<Dim>(problem.mesh.points, problem.mesh.cells);
    const auto places = locate_points(problem.mesh, points);
    const Square<Dim> a = linear_part<Dim>();
    const PointList<Dim> pose = (a * problem.cage.points).array() + 3;
    const auto expect_linear_part = [&](const Eigen::MatrixXd& found) {
      ASSERT_EQ(found.cols(), points.cols());
      for (Eigen::Index p = 0; p < found.cols(); ++p) {
        EXPECT_LT((at<Dim>(found, p) - a).norm(), 1e-9) << p;
      }
    };
    expect_linear_part(jacobians(gradients_at(problem.mesh, weights, places), pose));
  }
}

TEST_IN_2D_AND_3D(GradientsTest, AtVerticesTheyAreMeansOfCells) {
  const auto sample = make_sample<Dim>(Shape::kRing, 4, 0.2);
  const WeightMatrix weights = WeightMatrix::Random(3, sample.mesh.num_vertices());
  WeightMatrix sums = WeightMatrix::Zero(3 * Dim, sample.mesh.num_vertices());
  Eigen::VectorXd measures = Eigen::VectorXd::Zero(sample.mesh.num_vertices());
  for (Index s = 0; s < sample.mesh.num_cells(); ++s) {
    const double measure = signed_measure(sample.mesh, s);
    const auto corners = sample.mesh.cells.col(s);
    Square<Dim> edges;
    WeightMatrix rises(3, Dim);
    for (int k = 0; k < Dim; ++k) {
      edges.col(k) = sample.mesh.points.col(corners[k + 1]) - sample.mesh.points.col(corners[0]);
      rises.col(k) = weights.col(corners[k + 1]) - weights.col(corners[0]);
    }
    const WeightMatrix of_cell = (rises * edges.inverse()).transpose();
    for (const Index v : corners) {
      sums.col(v) += measure * of_cell.reshaped();
      measures[v] += measure;
    }
  }
  const WeightMatrix means = sums * measures.cwiseInverse().asDiagonal();
  EXPECT_LT((vertex_gradients(sample.mesh, weights).dense() - means).cwiseAbs().maxCoeff(), 1e-10);
}

TEST(Gradients, PointsOutsideHaveThoseOfTheNearestPointOfTheCage) {
  const auto sample = make_sample<3>(Shape::kRing, 4);
  PointList<3> points(3, 2);
  points.col(0) = sample.cage.points.col(0);
  points.col(1) = points.col(0) + points.col(0) - sample.mesh.points.rowwise().mean();
  const auto placement = place_points(sample.cage, sample.mesh, points, OutsidePoints::kNearest);
  const auto places = places_in_mesh(sample.cage, sample.mesh, placement);
  ASSERT_EQ(placement.places[1].cell, -1);
  for (const auto& place : places) ASSERT_GE(place.cell, 0);
  const auto found = interpolate(sample.mesh, sample.mesh.points, places).dense();
  EXPECT_LT((found.col(1) - placement.points.col(1)).norm(), 1e-9);
}

TEST(Gradients, OtherNumbersOfControlPointsAreRefused) {
  EXPECT_THROW(jacobians<2>(WeightMatrix(WeightMatrix::Zero(6, 1)), PointList<2>::Zero(2, 4)),
               InputError);
}

}  // namespace
}  // namespace flbc::testing
