// SPDX-License-Identifier: BSD-3-Clause
// Weights that go from one version of a model to another.
#include "flbc/binding.h"
#include "flbc/non_negative.h"
#include "flbc/pointwise.h"
#include "support/test.h"

namespace flbc::testing {
namespace {

// The triangles of a mesh of the interior as a model, with weights >= 0.
template <int Dim>
struct TransferTest {
  TransferTest() : sample(make_sample<Dim>(Shape::kRing, 3, 0.2)) {
    model.points = sample.mesh.points;
    const auto& cells = sample.mesh.cells;
    model.corners.resize(3, 2 * cells.cols());
    model.corners << cells.template topRows<3>(), cells.template bottomRows<3>();
    weights = mean_value_coordinates<Dim>(sample.cage, model.points);
    weights = project_non_negative<Dim>(sample.cage.points, model.points, weights).dense();
    size = bounding_box_diagonal<Dim>(model.points);
  }
  WeightMatrix transfer(const PointList<Dim>& to, double limit,
                        Eigen::VectorXd* distances = nullptr) const {
    return transfer_from(model.corners, to, limit, distances);
  }
  WeightMatrix transfer_from(const FacetList<3>& elements, const PointList<Dim>& to, double limit,
                             Eigen::VectorXd* distances = nullptr) const {
    return bound_by<Dim>(sample.cage, model.points, weights)
        .transferred(elements, to, {}, limit, distances)
        .weights.dense();
  }
  PointList<Dim> corners(Index element) const {
    return model.points(Eigen::all, model.corners.col(element));
  }

  Sample<Dim> sample;
  ModelElements<Dim> model;
  WeightMatrix weights;
  double size;
};

TEST_IN_2D_AND_3D(TransferTest, TheSameModelKeepsItsWeights) {
  TransferTest<Dim> t;
  EXPECT_LT((t.transfer(t.model.points, 1e-12) - t.weights).cwiseAbs().maxCoeff(), 1e-12);
}

TEST_IN_2D_AND_3D(TransferTest, FinerVersionsAreInterpolated) {
  TransferTest<Dim> t;
  const Index num_elements = static_cast<Index>(t.model.corners.cols());
  PointList<Dim> finer(Dim, num_elements);
  WeightMatrix expected(t.weights.rows(), num_elements);
  for (Index e = 0; e < num_elements; ++e) {
    const auto corners = t.model.corners.col(e);
    finer.col(e) = (t.model.points(Eigen::all, corners)).rowwise().mean();
    expected.col(e) = (t.weights(Eigen::all, corners)).rowwise().mean();
  }
  EXPECT_LT((t.transfer(finer, 1e-12) - expected).cwiseAbs().maxCoeff(), 1e-12);
}

TEST_IN_2D_AND_3D(TransferTest, PointsBesideAreReproducedFromTheNearestPlace) {
  TransferTest<Dim> t;
  std::mt19937 random(5);
  std::uniform_real_distribution<double> part(-1, 1);
  // Corners moved toward the middle of a cell, so that all stay inside the cage.
  PointList<Dim> moved = t.model.points;
  for (Index s = 0; s < t.sample.mesh.num_cells(); ++s) {
    const Index v = t.sample.mesh.cells(0, s);
    const Vector<Dim> middle =
        t.model.points(Eigen::all, t.sample.mesh.cells.col(s)).rowwise().mean();
    moved.col(v) =
        t.model.points.col(v) + 0.1 * (1 + part(random)) * (middle - t.model.points.col(v));
  }
  Eigen::VectorXd distances;
  const auto weights = t.transfer(moved, t.size, &distances);
  EXPECT_GE(weights.minCoeff(), 0);
  EXPECT_LT((weights.colwise().sum().array() - 1).abs().maxCoeff(), 1e-12);
  EXPECT_LT((t.sample.cage.points * weights - moved).cwiseAbs().maxCoeff(), 1e-12 * t.size);
  ASSERT_EQ(distances.size(), moved.cols());
  // The nearest place: no place on any triangle, by a fine grid, is nearer.
  for (Index p = 0; p < moved.cols(); p += 7) {
    for (Index e = 0; e < t.model.corners.cols(); ++e) {
      const auto corners = t.corners(e);
      constexpr int kSteps = 6;
      for (int a = 0; a <= kSteps; ++a) {
        for (int b = 0; a + b <= kSteps; ++b) {
          const Vector<Dim> place =
              (corners.col(0) * (kSteps - a - b) + corners.col(1) * a + corners.col(2) * b) /
              kSteps;
          ASSERT_GE((place - moved.col(p)).norm(), distances[p] - 1e-12);
        }
      }
    }
  }
}

TEST_IN_2D_AND_3D(TransferTest, UnmatchedPointsAreNamed) {
  TransferTest<Dim> t;
  auto to = t.model.points;
  to.col(4).array() += 3 * t.size;
  to.col(9).array() += 2 * t.size;
  expect_error<InputError>(
      [&] { t.transfer(to, 0.01 * t.size); },
      {"2 of " + std::to_string(to.cols()) + " vertices (4 and 9)", "the farthest is vertex 4"});
}

TEST_IN_2D_AND_3D(TransferTest, SegmentsAndPointsAreElementsToo) {
  TransferTest<Dim> t;
  auto segments = t.model.corners;
  segments.row(2) = segments.row(1);
  const PointList<Dim> middle =
      (t.model.points.col(t.model.corners(0, 0)) + t.model.points.col(t.model.corners(1, 0))) / 2;
  const auto at = t.transfer_from(segments, middle, 1e-12);
  const Eigen::VectorXd expected =
      (t.weights.col(t.model.corners(0, 0)) + t.weights.col(t.model.corners(1, 0))) / 2;
  EXPECT_LT((at.col(0) - expected).cwiseAbs().maxCoeff(), 1e-12);
  segments(0, 0) = -1;
  EXPECT_THROW(t.transfer_from(segments, middle, 1), InputError);
  segments.resize(3, 0);
  EXPECT_THROW(t.transfer_from(segments, middle, 1), InputError);
}

}  // namespace
}  // namespace flbc::testing
