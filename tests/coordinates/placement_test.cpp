// SPDX-License-Identifier: BSD-3-Clause
// Weights at points inside a cage, beside it by a hair, and outside.
#include "flbc/placement.h"

#include <cmath>
#include <type_traits>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "flbc/bounding_box.h"
#include "flbc/cage_facts.h"
#include "flbc/errors.h"
#include "flbc/mean_value.h"
#include "flbc/sparsify.h"
#include "support/sample_meshes.h"

namespace flbc::testing {
namespace {

// Cages whose facets have their normals outwards, with weights that are linear on every facet.
template <class Dimension>
class PlacementTest : public ::testing::Test {
 protected:
  static constexpr int kDimension = Dimension::value;

  explicit PlacementTest(Shape shape = Shape::kCorner)
      : sample_(make_sample<kDimension>(shape, 4)) {
    size_ = bounding_box_diagonal<kDimension>(sample_.cage.points);
    weights_ = mean_value_coordinates<kDimension>(sample_.cage, sample_.mesh.points).cwiseMax(0);
    weights_.array().rowwise() /= weights_.colwise().sum().array().eval();
  }

  Vector<kDimension> corner(Index facet, int k) const {
    return sample_.cage.points.col(sample_.cage.facets(k, facet));
  }
  Vector<kDimension> normal(Index facet) const {
    if constexpr (kDimension == 2) {
      const Vector<2> along = corner(facet, 1) - corner(facet, 0);
      return Vector<2>(along.y(), -along.x()).normalized();
    } else {
      return (corner(facet, 1) - corner(facet, 0))
          .cross(corner(facet, 2) - corner(facet, 0))
          .normalized();
    }
  }
  // At the middle of every facet, and beside its first corner.
  PointList<kDimension> off_the_facets(double distance) const {
    const Index num_facets = static_cast<Index>(sample_.cage.facets.cols());
    PointList<kDimension> points(kDimension, 2 * num_facets);
    for (Index f = 0; f < num_facets; ++f) {
      Vector<kDimension> middle = Vector<kDimension>::Zero();
      for (int k = 0; k < kDimension; ++k) middle += corner(f, k) / kDimension;
      points.col(2 * f) = middle + distance * normal(f);
      points.col(2 * f + 1) = corner(f, 0) + 1e-3 * (middle - corner(f, 0)) + distance * normal(f);
    }
    return points;
  }
  WeightMatrix weights_at_points(const PointList<kDimension>& points, OutsidePoints policy) const {
    return weights_at(sample_.cage, sample_.mesh, weights_,
                      place_points(sample_.cage, sample_.mesh, points, policy));
  }
  void expect_sums_are_one(const WeightMatrix& weights) const {
    EXPECT_LT((weights.colwise().sum().array() - 1).abs().maxCoeff(), 1e-13);
  }

  Sample<kDimension> sample_;
  WeightMatrix weights_;
  double size_ = 0;
};
using Dimensions = ::testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(PlacementTest, Dimensions);

TYPED_TEST(PlacementTest, AHairOutsideIsOnTheCageForEverybody) {
  constexpr int kDim = TypeParam::value;
  const auto& cage = this->sample_.cage;
  for (const double part : {0.0, 1e-13, 1e-11, 1e-9, 1e-8, 1e-7, 9e-7}) {
    SCOPED_TRACE(part);
    const auto points = this->off_the_facets(part * this->size_);
    EXPECT_TRUE(points_outside(cage, points).empty());
    const auto placement = place_points(cage, this->sample_.mesh, points);
    EXPECT_TRUE(placement.outside.empty());
    if (part >= 1e-11) {
      EXPECT_EQ(static_cast<Eigen::Index>(placement.on_cage.size()), points.cols());
    }
    const auto weights = weights_at(cage, this->sample_.mesh, this->weights_, placement);
    EXPECT_GE(weights.minCoeff(), 0);
    this->expect_sums_are_one(weights);
    const PointList<kDim> places = cage.points * weights;
    EXPECT_LT((places - points).colwise().norm().maxCoeff(), (part + 1e-12) * this->size_ * 1.01);
    EXPECT_LT((places - placement.points).cwiseAbs().maxCoeff(), 1e-12 * this->size_);
    const SparsifyOptions few{kDim + 1};
    for (const auto& some : {points, placement.points}) {
      const auto sparse = sparsify<kDim>(cage.points, some, weights, few);
      EXPECT_GE(sparse.minCoeff(), 0);
    }
  }
  for (const double part : {1.1e-6, 1e-5, 1e-2}) {
    SCOPED_TRACE(part);
    const auto points = this->off_the_facets(part * this->size_);
    const auto outside = points_outside(cage, points);
    const auto placement = place_points(cage, this->sample_.mesh, points, OutsidePoints::kNearest);
    ASSERT_EQ(placement.outside.size(), outside.size());
    for (std::size_t k = 0; k < outside.size(); ++k) {
      EXPECT_EQ(placement.outside[k].point, outside[k]);
    }
    EXPECT_THROW(place_points(cage, this->sample_.mesh, points), InputError);
  }
}

TYPED_TEST(PlacementTest, PointsInsideAreInterpolated) {
  constexpr int kDim = TypeParam::value;
  const auto points = this->off_the_facets(-0.01 * this->size_);
  const auto placement = place_points(this->sample_.cage, this->sample_.mesh, points);
  EXPECT_TRUE(placement.on_cage.empty());
  const auto weights = this->weights_at_points(points, OutsidePoints::kFail);
  this->expect_sums_are_one(weights);
  const PointList<kDim> before = this->sample_.mesh.points;
  // Linear functions of the place are reproduced whatever the weights of the mesh are.
  for (Eigen::Index p = 0; p < points.cols(); ++p) {
    const auto& place = placement.places[p];
    Vector<kDim> found = Vector<kDim>::Zero();
    for (int k = 0; k <= kDim; ++k) {
      found += place.coordinates[k] * before.col(this->sample_.mesh.cells(k, place.cell));
    }
    EXPECT_LT((found - points.col(p)).norm(), 1e-12 * this->size_);
  }
}

TYPED_TEST(PlacementTest, RefusalsNameTheFarthest) {
  auto points = this->off_the_facets(-0.01 * this->size_);
  points.col(1) = this->corner(0, 0) + 0.25 * this->size_ * this->normal(0);
  points.col(3).setConstant(100 * this->size_);
  try {
    place_points(this->sample_.cage, this->sample_.mesh, points);
    FAIL();
  } catch (const InputError& error) {
    const std::string message = error.what();
    EXPECT_NE(message.find("2 of " + std::to_string(points.cols()) + " points lie outside"),
              std::string::npos)
        << message;
    EXPECT_NE(message.find("the farthest is vertex 3"), std::string::npos) << message;
    for (const char* advice : {"--outside nearest", "--outside extend", "flbc cage"}) {
      EXPECT_NE(message.find(advice), std::string::npos) << message;
    }
  }
}

TYPED_TEST(PlacementTest, NearestIsTheNearestPointOfTheCage) {
  constexpr int kDim = TypeParam::value;
  const auto& cage = this->sample_.cage;
  const auto points = this->off_the_facets(0.2 * this->size_);
  const auto placement = place_points(cage, this->sample_.mesh, points, OutsidePoints::kNearest);
  const auto weights = weights_at(cage, this->sample_.mesh, this->weights_, placement);
  ASSERT_GT(placement.outside.size(), 0u);
  this->expect_sums_are_one(weights);
  const PointList<kDim> places = cage.points * weights;
  EXPECT_LT((places - placement.points).cwiseAbs().maxCoeff(), 1e-12);
  for (const auto& [point, facet, coordinates, distance] : placement.outside) {
    EXPECT_GE(weights.col(point).minCoeff(), 0);
    EXPECT_LE((weights.col(point).array() > 0).count(), kDim);
    EXPECT_NEAR((places.col(point) - points.col(point)).norm(), distance, 1e-12);
    // No place on any facet is nearer.
    for (Index f = 0; f < cage.facets.cols(); ++f) {
      constexpr int kSteps = 12;
      for (int a = 0; a <= kSteps; ++a) {
        for (int b = 0; b <= (kDim == 2 ? 0 : kSteps - a); ++b) {
          Vector<kDim> place = this->corner(f, 0);
          place += (this->corner(f, 1) - this->corner(f, 0)) * a / kSteps;
          if (kDim == 3) place += (this->corner(f, 2) - this->corner(f, 0)) * b / kSteps;
          EXPECT_GE((place - points.col(point)).norm(), distance - 1e-12);
        }
      }
    }
  }
}

TYPED_TEST(PlacementTest, ExtendedWeightsReproducePointsAndAffineMaps) {
  constexpr int kDim = TypeParam::value;
  const auto& cage = this->sample_.cage;
  for (const double part : {1e-4, 0.05, 0.5}) {
    SCOPED_TRACE(part);
    const auto points = this->off_the_facets(part * this->size_);
    const auto weights = this->weights_at_points(points, OutsidePoints::kExtend);
    this->expect_sums_are_one(weights);
    // Points outside are reproduced; those that have come inside again are the mesh's business.
    const auto outside = points_outside(cage, points);
    ASSERT_GT(outside.size(), 0u);
    Eigen::Matrix<double, kDim, kDim> map = Eigen::Matrix<double, kDim, kDim>::Identity();
    map(0, kDim - 1) = 0.7;
    map(1, 1) = -2;
    const PointList<kDim> pose = (map * cage.points).array() + 3;
    for (const Index p : outside) {
      const Vector<kDim> expected = (map * points.col(p)).array() + 3;
      EXPECT_LT((cage.points * weights.col(p) - points.col(p)).norm(), 1e-12 * this->size_);
      EXPECT_LT((pose * weights.col(p) - expected).norm(), 1e-11 * this->size_);
    }
  }
}

TYPED_TEST(PlacementTest, ExtensionIsContinuousAcrossTheCageAndRoundConvexEdges) {
  constexpr int kDim = TypeParam::value;
  constexpr double kStep = 1e-5;
  const auto sample = make_sample<kDim>(Shape::kBox, 3);
  const auto& cage = sample.cage;
  const auto weights = mean_value_coordinates<kDim>(cage, sample.mesh.points);
  // A straight line from inside through a facet and round the box's edges and corners.
  const Vector<kDim> center = cage.points.rowwise().mean();
  const double size = bounding_box_diagonal<kDim>(cage.points);
  Vector<kDim> along = Vector<kDim>::Zero();
  along[0] = 1;
  along[1] = 0.61;
  constexpr int kPoints = 400;
  PointList<kDim> points(kDim, 2 * kPoints);
  for (int k = 0; k < kPoints; ++k) {
    const double angle = 0.02 * k;
    Vector<kDim> place = center + size * k / kPoints * along;
    if (k >= kPoints / 2) {  // round the box
      place = center;
      place[0] += size * std::cos(angle);
      place[1] += size * std::sin(angle);
      place[kDim - 1] += kDim == 3 ? 0.3 * size * std::sin(3 * angle) : 0;
    }
    points.col(2 * k) = place;
    points.col(2 * k + 1) = place + kStep * size * along;
  }
  const auto extended = weights_at(cage, sample.mesh, weights,
                                   place_points(cage, sample.mesh, points, OutsidePoints::kExtend));
  for (int k = 0; k < kPoints; ++k) {
    const double change = (extended.col(2 * k) - extended.col(2 * k + 1)).norm();
    EXPECT_LT(change, 20 * kStep) << k;
  }
}

// Whatever becomes of points, weights without their zeros say the same.
TYPED_TEST(PlacementTest, SparseWeightsGiveTheSame) {
  constexpr int kDim = TypeParam::value;
  const auto& sample = this->sample_;
  WeightMatrix local = (this->weights_.array() < 0.1).select(0, this->weights_);
  local.array().rowwise() /= local.colwise().sum().array().eval();
  PointList<kDim> points(kDim, 0);
  for (const double distance : {-1e-2, 1e-8, 0.1}) {  // inside, on the cage, outside
    const auto more = this->off_the_facets(distance * this->size_);
    const auto before = points.cols();
    points.conservativeResize(kDim, before + more.cols());
    points.rightCols(more.cols()) = more;
  }
  for (const auto policy : {OutsidePoints::kNearest, OutsidePoints::kExtend}) {
    const auto placement = place_points(sample.cage, sample.mesh, points, policy);
    EXPECT_GT(placement.outside.size(), 0);
    const auto dense = weights_at(sample.cage, sample.mesh, local, placement);
    const auto sparse = weights_at(sample.cage, sample.mesh, SparseWeights(local), placement);
    EXPECT_EQ(sparse.dense(), dense);
    EXPECT_LT(sparse.values().size(), dense.size());
  }
}

}  // namespace
}  // namespace flbc::testing
