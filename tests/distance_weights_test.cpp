// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/distance_weights.h"

#include <algorithm>
#include <cmath>
#include <limits>
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

// In a convex domain geodesics are straight, and then nothing is lost on any mesh, in any units.
TYPED_TEST(DistanceWeightsTest, AreEuclideanInABox) {
  constexpr int kDim = TypeParam::value;
  for (const Index resolution : {3, kDim == 2 ? 40 : 12}) {
    for (const double unit : {1e-3, 1.0, 1e3}) {
      auto sample = make_sample<kDim>(Shape::kBox, resolution, 0.2);
      sample.mesh.points *= unit;
      sample.cage.points *= unit;
      const auto& mesh = sample.mesh;
      const auto topology = build_topology(mesh);
      const auto sources = boundary_values(sample.cage, mesh, topology).control_vertices;
      const auto distances = geodesic_distances(mesh, topology, sources);
      const double diagonal = size_of(sample.cage.points);
      for (std::size_t i = 0; i < sources.size(); ++i) {
        EXPECT_EQ(distances(i, sources[i]), 0);
        for (Index v = 0; v < mesh.num_vertices(); ++v) {
          const double straight = (mesh.points.col(v) - mesh.points.col(sources[i])).norm();
          EXPECT_NEAR(distances(i, v), straight, 1e-5 * diagonal) << unit << ' ' << i << ' ' << v;
        }
      }
    }
  }
}

// The way between two points of a square with a square hole, where it is no longer than one corner
// of the hole away from straight; infinite otherwise.
double way_round_hole(const Eigen::Vector2d& a, const Eigen::Vector2d& b, double hole) {
  const auto crosses_hole = [&](const Eigen::Vector2d& from, const Eigen::Vector2d& to) {
    // Cut to the hole's open square, coordinate by coordinate.
    double enter = 0;
    double leave = 1;
    for (int d = 0; d < 2; ++d) {
      const double step = to[d] - from[d];
      if (step == 0) {
        if (std::abs(from[d]) >= hole * (1 - 1e-9)) return false;
        continue;
      }
      const double first = (-hole - from[d]) / step;
      const double second = (hole - from[d]) / step;
      enter = std::max(enter, std::min(first, second));
      leave = std::min(leave, std::max(first, second));
    }
    return leave - enter > 1e-9;
  };
  if (!crosses_hole(a, b)) return (b - a).norm();
  double shortest = std::numeric_limits<double>::infinity();
  for (const double x : {-hole, hole}) {
    for (const double y : {-hole, hole}) {
      const Eigen::Vector2d corner(x, y);
      if (crosses_hole(a, corner) || crosses_hole(corner, b)) continue;
      shortest = std::min(shortest, (corner - a).norm() + (b - corner).norm());
    }
  }
  return shortest;
}

// Round the hole of a ring the way bends; in 3D, a way is what it is in the plane, and straight in
// the third direction. Behind the bend the error is of the order of a cell.
TYPED_TEST(DistanceWeightsTest, GoRoundHoles) {
  constexpr int kDim = TypeParam::value;
  const auto error_of = [](Index resolution) {
    const auto sample = make_sample<kDim>(Shape::kRing, resolution);
    const auto& mesh = sample.mesh;
    const auto middle =
        ((mesh.points.rowwise().minCoeff() + mesh.points.rowwise().maxCoeff()) / 2).eval();
    // Of all control points, those of the hole are the nearest to the middle in the plane.
    double hole = std::numeric_limits<double>::infinity();
    for (const auto& corner : sample.cage.points.colwise()) {
      hole = std::min(hole, (corner - middle).template head<2>().cwiseAbs().maxCoeff());
    }
    const auto topology = build_topology(mesh);
    const auto sources = boundary_values(sample.cage, mesh, topology).control_vertices;
    const auto distances = geodesic_distances(mesh, topology, sources);
    double worst = 0;
    int num_bent = 0;
    for (std::size_t i = 0; i < sources.size(); ++i) {
      const auto source = (mesh.points.col(sources[i]) - middle).eval();
      for (Index v = 0; v < mesh.num_vertices(); ++v) {
        const auto point = (mesh.points.col(v) - middle).eval();
        const double in_plane =
            way_round_hole(source.template head<2>(), point.template head<2>(), hole);
        if (!std::isfinite(in_plane)) continue;
        const double rise = kDim == 3 ? point[kDim - 1] - source[kDim - 1] : 0.0;
        const double way = std::hypot(in_plane, rise);
        worst = std::max(worst, std::abs(distances(i, v) - way));
        num_bent += way > (point - source).norm() * 1.02 ? 1 : 0;
      }
    }
    EXPECT_GT(num_bent, 10);
    // The hole is as wide as the ring, and `resolution` cells wide.
    EXPECT_LT(worst, 2 * 2 * hole / static_cast<double>(resolution)) << resolution;
    return worst;
  };
  const double coarse = error_of(kDim == 2 ? 4 : 3);
  const double fine = error_of(kDim == 2 ? 32 : 9);
  EXPECT_LT(fine, coarse);
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
