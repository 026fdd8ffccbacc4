// SPDX-License-Identifier: BSD-3-Clause
// The radius within which control points can carry a point, against all simplices of them.
#include <random>

#include "flbc/bounding_box.h"
#include "flbc/check.h"
#include "support/sample_meshes.h"
#include "support/test.h"

namespace flbc::testing {
namespace {

// Each point of a hull lies in a simplex of the points that span it (Carathéodory): the least
// radius is that of the best simplex. Goes through all subsets of Dim + 1 control points.
template <int Dim>
double least_radius(const PointList<Dim>& control_points, const Vector<Dim>& point) {
  const auto n = static_cast<int>(control_points.cols());
  std::vector<int> chosen(n, 0);
  std::fill(chosen.begin(), chosen.begin() + Dim + 1, 1);
  double least = std::numeric_limits<double>::infinity();
  do {
    Eigen::Matrix<double, Dim + 1, Dim + 1> corners;
    Eigen::Matrix<double, Dim + 1, 1> wanted;
    wanted << point, 1;
    double radius = 0;
    for (int i = 0, k = 0; i < n; ++i) {
      if (chosen[i] == 0) continue;
      corners.col(k++) << control_points.col(i), 1;
      radius = std::max(radius, (control_points.col(i) - point).norm());
    }
    if (std::abs(corners.determinant()) < 1e-9) continue;
    if (corners.inverse().eval().lazyProduct(wanted).minCoeff() < -1e-9) continue;
    least = std::min(least, radius);
  } while (std::prev_permutation(chosen.begin(), chosen.end()));
  return least;
}

template <int Dim>
PointList<Dim> random_points_in_hull(const PointList<Dim>& control_points, Index count) {
  std::mt19937 random(3);
  std::exponential_distribution<double> exponential;
  PointList<Dim> points(Dim, count);
  for (Index p = 0; p < count; ++p) {
    Eigen::VectorXd weights(control_points.cols());
    for (double& weight : weights) weight = std::pow(exponential(random), 3);
    points.col(p) = control_points * weights / weights.sum();
  }
  return points;
}

TEST_IN_2D_AND_3D(LeastReachTest, AgreesWithAllSimplices) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> coordinate(0, 1);
  for (const Index n : {Dim + 1, Dim + 5, 12}) {
    SCOPED_TRACE(n);
    Cage<Dim> cage;
    cage.points.resize(Dim, n);
    for (double& x : cage.points.reshaped()) x = coordinate(random);
    const auto points = random_points_in_hull<Dim>(cage.points, 31);
    const double size = bounding_box_diagonal(cage.points);
    std::vector<double> expected;
    for (Index p = 0; p < points.cols(); ++p) {
      expected.push_back(least_radius<Dim>(cage.points, points.col(p)) / size);
      EXPECT_NEAR(least_reach<Dim>(cage, points.col(p)).maximum.value, expected.back(), 1e-9) << p;
    }
    const auto reach = least_reach(cage, points);
    const auto largest = std::max_element(expected.begin(), expected.end());
    EXPECT_NEAR(reach.maximum.value, *largest, 1e-9);
    EXPECT_EQ(reach.maximum.point, largest - expected.begin());
    EXPECT_EQ(reach.maximum.place, points.col(reach.maximum.point));
    EXPECT_NEAR((cage.points.col(reach.maximum.control_point) - reach.maximum.place).norm(),
                reach.maximum.value * size, 1e-12);
    std::sort(expected.begin(), expected.end());
    EXPECT_NEAR(reach.median, expected[15], 1e-9);
  }
}

TEST_IN_2D_AND_3D(LeastReachTest, ControlPointsNeedNoOther) {
  const auto sample = make_sample<Dim>(Shape::kStar, 3, 0.2);
  const auto reach = least_reach(sample.cage, sample.cage.points);
  EXPECT_EQ(reach.maximum.value, 0);
  EXPECT_EQ(reach.median, 0);
}

TEST_IN_2D_AND_3D(LeastReachTest, PointsOutsideTheHullAreLeftOut) {
  const auto sample = make_sample<Dim>(Shape::kBox, 3, 0.2);
  const Vector<Dim> high = sample.cage.points.rowwise().maxCoeff();
  PointList<Dim> points(Dim, 2);
  points << 2 * high, sample.cage.points.rowwise().mean();
  EXPECT_EQ(least_reach(sample.cage, points).maximum.point, 1);
  EXPECT_EQ(least_reach<Dim>(sample.cage, points.col(0)).maximum.point, -1);
}

}  // namespace
}  // namespace flbc::testing
