// SPDX-License-Identifier: BSD-3-Clause
// Weights that go from one version of a model to another.
#include "flbc/transfer_weights.h"

#include <random>
#include <type_traits>

#include <gtest/gtest.h>

#include "flbc/bounding_box.h"
#include "flbc/errors.h"
#include "flbc/mean_value.h"
#include "flbc/non_negative.h"
#include "support/sample_meshes.h"

namespace flbc::testing {
namespace {

// The triangles of a mesh of the interior as a model, with weights >= 0.
template <class Dimension>
class TransferTest : public ::testing::Test {
 protected:
  static constexpr int kDimension = Dimension::value;

  TransferTest() : sample_(make_sample<kDimension>(Shape::kRing, 3, 0.2)) {
    model_.points = sample_.mesh.points;
    const auto& cells = sample_.mesh.cells;
    model_.corners.resize(3, 2 * cells.cols());
    model_.corners << cells.template topRows<3>(), cells.template bottomRows<3>();
    weights_ = mean_value_coordinates<kDimension>(sample_.cage, model_.points);
    project_non_negative<kDimension>(sample_.cage.points, model_.points, weights_);
    size_ = bounding_box_diagonal<kDimension>(model_.points);
  }
  WeightMatrix transfer(const PointList<kDimension>& to, double limit,
                        Eigen::VectorXd* distances = nullptr) const {
    return transfer_weights<kDimension>(sample_.cage.points, model_, weights_, to, limit,
                                        distances);
  }
  PointList<kDimension> corners(Index element) const {
    return model_.points(Eigen::all, model_.corners.col(element));
  }

  Sample<kDimension> sample_;
  ModelElements<kDimension> model_;
  WeightMatrix weights_;
  double size_;
};
using Dimensions = ::testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(TransferTest, Dimensions);

TYPED_TEST(TransferTest, TheSameModelKeepsItsWeights) {
  EXPECT_LT((this->transfer(this->model_.points, 1e-12) - this->weights_).cwiseAbs().maxCoeff(),
            1e-12);
}

TYPED_TEST(TransferTest, FinerVersionsAreInterpolated) {
  constexpr int kDim = TypeParam::value;
  const Index num_elements = static_cast<Index>(this->model_.corners.cols());
  PointList<kDim> finer(kDim, num_elements);
  WeightMatrix expected(this->weights_.rows(), num_elements);
  for (Index e = 0; e < num_elements; ++e) {
    const auto corners = this->model_.corners.col(e);
    finer.col(e) = (this->model_.points(Eigen::all, corners)).rowwise().mean();
    expected.col(e) = (this->weights_(Eigen::all, corners)).rowwise().mean();
  }
  EXPECT_LT((this->transfer(finer, 1e-12) - expected).cwiseAbs().maxCoeff(), 1e-12);
}

TYPED_TEST(TransferTest, PointsBesideAreReproducedFromTheNearestPlace) {
  constexpr int kDim = TypeParam::value;
  std::mt19937 random(5);
  std::uniform_real_distribution<double> part(-1, 1);
  // Corners moved towards the middle of a cell, so that all stay inside the cage.
  PointList<kDim> moved = this->model_.points;
  for (Index s = 0; s < this->sample_.mesh.num_cells(); ++s) {
    const Index v = this->sample_.mesh.cells(0, s);
    const Vector<kDim> middle =
        this->model_.points(Eigen::all, this->sample_.mesh.cells.col(s)).rowwise().mean();
    moved.col(v) = this->model_.points.col(v) +
                   0.1 * (1 + part(random)) * (middle - this->model_.points.col(v));
  }
  Eigen::VectorXd distances;
  const auto weights = this->transfer(moved, this->size_, &distances);
  EXPECT_GE(weights.minCoeff(), 0);
  EXPECT_LT((weights.colwise().sum().array() - 1).abs().maxCoeff(), 1e-12);
  EXPECT_LT((this->sample_.cage.points * weights - moved).cwiseAbs().maxCoeff(),
            1e-12 * this->size_);
  ASSERT_EQ(distances.size(), moved.cols());
  // The nearest place: no place on any triangle, by a fine grid, is nearer.
  for (Index p = 0; p < moved.cols(); p += 7) {
    for (Index e = 0; e < this->model_.corners.cols(); ++e) {
      const auto corners = this->corners(e);
      constexpr int kSteps = 6;
      for (int a = 0; a <= kSteps; ++a) {
        for (int b = 0; a + b <= kSteps; ++b) {
          const Vector<kDim> place =
              (corners.col(0) * (kSteps - a - b) + corners.col(1) * a + corners.col(2) * b) /
              kSteps;
          ASSERT_GE((place - moved.col(p)).norm(), distances[p] - 1e-12);
        }
      }
    }
  }
}

TYPED_TEST(TransferTest, UnmatchedPointsAreNamed) {
  auto to = this->model_.points;
  to.col(4).array() += 3 * this->size_;
  to.col(9).array() += 2 * this->size_;
  try {
    this->transfer(to, 0.01 * this->size_);
    FAIL();
  } catch (const InputError& error) {
    const std::string message = error.what();
    EXPECT_NE(message.find("2 of " + std::to_string(to.cols()) + " vertices (4, 9)"),
              std::string::npos)
        << message;
    EXPECT_NE(message.find("the farthest is vertex 4"), std::string::npos) << message;
  }
}

TYPED_TEST(TransferTest, SegmentsAndPointsAreElementsToo) {
  constexpr int kDim = TypeParam::value;
  auto segments = this->model_;
  segments.corners.row(2) = segments.corners.row(1);
  const PointList<kDim> middle =
      (this->model_.points.col(this->model_.corners(0, 0)) +
       this->model_.points.col(this->model_.corners(1, 0))) /
      2;
  const auto at = transfer_weights<kDim>(this->sample_.cage.points, segments, this->weights_,
                                         middle, 1e-12);
  const Eigen::VectorXd expected = (this->weights_.col(this->model_.corners(0, 0)) +
                                    this->weights_.col(this->model_.corners(1, 0))) /
                                   2;
  EXPECT_LT((at.col(0) - expected).cwiseAbs().maxCoeff(), 1e-12);
  segments.corners(0, 0) = -1;
  EXPECT_THROW(transfer_weights<kDim>(this->sample_.cage.points, segments, this->weights_, middle,
                                      1),
               InputError);
  segments.corners.resize(3, 0);
  EXPECT_THROW(transfer_weights<kDim>(this->sample_.cage.points, segments, this->weights_, middle,
                                      1),
               InputError);
}

}  // namespace
}  // namespace flbc::testing
