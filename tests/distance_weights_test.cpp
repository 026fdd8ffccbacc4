// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/distance_weights.h"

#include <type_traits>

#include <gtest/gtest.h>

#include "flbc/lbc_problem.h"
#include "support/sample_meshes.h"

namespace flbc::testing {
namespace {

template <class Dimension>
class DistanceWeightsTest : public ::testing::Test {};
using Dimensions = ::testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(DistanceWeightsTest, Dimensions);

// In a convex domain geodesics are straight.
TYPED_TEST(DistanceWeightsTest, AreEuclideanInABox) {
  constexpr int kDim = TypeParam::value;
  const auto sample = make_sample<kDim>(Shape::kBox, kDim == 2 ? 40 : 12, 0.2);
  const auto problem = make_problem(sample.cage, sample.mesh, DistanceScheme::kConstant);
  const auto distances = geodesic_distances(problem.mesh, problem.boundary.control_vertices);
  const double diagonal = size_of(problem.cage.points);
  for (Index i = 0; i < problem.num_control_points(); ++i) {
    EXPECT_EQ(distances(i, problem.boundary.control_vertices[i]), 0);
    for (Index v = 0; v < problem.mesh.num_vertices(); ++v) {
      const double straight = (problem.mesh.points.col(v) - problem.cage.points.col(i)).norm();
      EXPECT_NEAR(distances(i, v), straight, (kDim == 2 ? 0.04 : 0.12) * diagonal);
    }
  }
}

// Round the hole of a ring the way is longer than the straight line.
TYPED_TEST(DistanceWeightsTest, GoRoundHoles) {
  constexpr int kDim = TypeParam::value;
  const auto sample = make_sample<kDim>(Shape::kRing, kDim == 2 ? 16 : 6);
  const auto problem = make_problem(sample.cage, sample.mesh, DistanceScheme::kConstant);
  const auto distances = geodesic_distances(problem.mesh, problem.boundary.control_vertices);
  // From one outer corner to the opposite one, along the hole's corner: 2 sqrt(1 + 4) of 3 sqrt(2).
  double longest_ratio = 0;
  for (Index i = 0; i < problem.num_control_points(); ++i) {
    for (Index j = 0; j < problem.num_control_points(); ++j) {
      const double straight = (problem.cage.points.col(i) - problem.cage.points.col(j)).norm();
      const double way = distances(i, problem.boundary.control_vertices[j]);
      if (straight > 100) longest_ratio = std::max(longest_ratio, way / straight);
    }
  }
  EXPECT_GT(longest_ratio, 1.04);
}

TYPED_TEST(DistanceWeightsTest, SchemesAreOrderedAndInTheUnitInterval) {
  constexpr int kDim = TypeParam::value;
  const auto sample = make_sample<kDim>(Shape::kCorner, 4, 0.2);
  const auto& mesh = sample.mesh;
  const auto n = sample.cage.size();
  const Eigen::MatrixXd distances = Eigen::MatrixXd::Random(n, mesh.num_vertices()).cwiseAbs();
  const auto square = distance_weights(DistanceScheme::kSquare, distances, mesh, n);
  const auto linear = distance_weights(DistanceScheme::kLinear, distances, mesh, n);
  const auto root = distance_weights(DistanceScheme::kSquareRoot, distances, mesh, n);
  const auto constant = distance_weights(DistanceScheme::kConstant, {}, mesh, n);
  EXPECT_TRUE((constant.array() == 1).all());
  EXPECT_GE(square.minCoeff(), 0);
  EXPECT_LE(root.maxCoeff(), 1);
  EXPECT_TRUE((square.array() <= linear.array()).all());
  EXPECT_TRUE((linear.array() <= root.array()).all());
  EXPECT_LT((linear.cwiseAbs2() - square).cwiseAbs().maxCoeff(), 1e-15);
  EXPECT_LT((root.cwiseAbs2() - linear).cwiseAbs().maxCoeff(), 1e-15);
  const double mean = distances(0, mesh.cells(0, 0)) + distances(0, mesh.cells(1, 0)) +
                      distances(0, mesh.cells(2, 0)) +
                      (kDim == 3 ? distances(0, mesh.cells(kDim, 0)) : 0);
  EXPECT_NEAR(linear(0, 0), mean / (kDim + 1) / distances.maxCoeff(), 1e-14);
}

}  // namespace
}  // namespace flbc::testing
