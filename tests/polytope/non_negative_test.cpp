// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/non_negative.h"

#include "polytope/nearest_point_in_hull.h"
#include "support/feasible_vertices.h"
#include "support/io_files.h"

namespace flbc::testing {
namespace {

// Rows that need anything from a small correction to a miracle.
WeightMatrix awkward_rows(Eigen::Index n, Eigen::Index count, Numbers& numbers) {
  WeightMatrix rows = numbers.matrix(n, count, -1, 1);
  for (Eigen::Index k = 0; k < count; ++k) {
    if (k % 5 == 1) rows.col(k) *= 1e6;
    if (k % 5 == 2) rows.col(k).setConstant(-1);
    if (k % 5 == 3) rows.col(k) = numbers.convex(n) + 1e-3 * rows.col(k);
    if (k % 5 == 4) rows.col(k) = rows.col(k).array().pow(9);
  }
  return rows;
}

template <int Dim>
void expect_feasible(const PointList<Dim>& control_points, const PointList<Dim>& points,
                     const WeightMatrix& weights) {
  const double size = bounding_box_diagonal<Dim>(control_points);
  const double far = (control_points.cwiseAbs().maxCoeff() + size) / size;
  for (Eigen::Index k = 0; k < points.cols(); ++k) {
    ASSERT_GE(weights.col(k).minCoeff(), 0) << "column " << k;
    for (const double weight : weights.col(k)) ASSERT_FALSE(std::signbit(weight));
    EXPECT_NEAR(weights.col(k).sum(), 1, 1e-13) << "column " << k;
    const PointList<Dim> offsets = control_points.colwise() - points.col(k);
    EXPECT_LE((offsets * weights.col(k)).norm(), 1e-13 * size * std::max(1.0, far / 100))
        << "column " << k;
  }
}

TEST_IN_2D_AND_3D(NonNegativeTest, RowsAreFeasibleForAwkwardCagesPointsAndRows) {
  for (const auto& [name, control_points] : awkward_control_points<Dim>()) {
    SCOPED_TRACE(name);
    Numbers numbers(7);
    const auto points = awkward_points<Dim>(control_points, numbers, 120);
    auto weights = awkward_rows(control_points.cols(), points.cols(), numbers);
    weights = project_non_negative<Dim>(control_points, points, weights).dense();
    expect_feasible<Dim>(control_points, points, weights);
  }
}

// The projection w of y is the only feasible row with (w - y) . (z - w) >= 0 for all feasible z,
// that is for the vertices of the set of feasible rows.
TEST_IN_2D_AND_3D(NonNegativeTest, NoFeasibleRowIsNearer) {
  Numbers numbers(11);
  std::vector<PointList<Dim>> cages{lattice<Dim>(2), numbers.matrix(Dim, 9, -1, 1)};
  for (int n = Dim + 1; n < 9; ++n) cages.push_back(numbers.matrix(Dim, n, -1, 1));
  // Three in a line, and two in one place.
  PointList<Dim> box = lattice<Dim>(2);
  box.conservativeResize(Dim, box.cols() + 2);
  box.rightCols(2) << (box.col(0) + box.col(1)) / 2, box.col(2);
  cages.push_back(box);
  for (const auto& control_points : cages) {
    SCOPED_TRACE(control_points.cols());
    const auto points = awkward_points<Dim>(control_points, numbers, 60);
    const auto rows = awkward_rows(control_points.cols(), points.cols(), numbers);
    auto weights = rows;
    weights = project_non_negative<Dim>(control_points, points, weights).dense();
    expect_feasible<Dim>(control_points, points, weights);
    for (Eigen::Index k = 0; k < points.cols(); ++k) {
      const Eigen::VectorXd gradient = weights.col(k) - rows.col(k);
      const auto vertices = feasible_vertices<Dim>(control_points, points.col(k), 1e-9);
      ASSERT_FALSE(vertices.empty());
      for (const auto& vertex : vertices) {
        EXPECT_GE(gradient.dot(vertex - weights.col(k)), -1e-8 * (1 + rows.col(k).norm()))
            << "column " << k;
      }
    }
  }
}

// w_i - y_i = mu . (1, c_i) where w_i > 0, and at least that elsewhere.
TEST_IN_2D_AND_3D(NonNegativeTest, MultipliersExistForManyControlPoints) {
  Numbers numbers(13);
  const PointList<Dim> control_points = numbers.matrix(Dim, 250, -1, 1);
  Eigen::MatrixXd constraints(250, Dim + 1);
  constraints << Eigen::VectorXd::Ones(250), control_points.transpose();
  PointList<Dim> points(Dim, 50);
  WeightMatrix rows = numbers.matrix(250, 50, -0.05, 0.05);
  for (int k = 0; k < 50; ++k) points.col(k) = control_points * numbers.convex(250);
  auto weights = rows;
  weights = project_non_negative<Dim>(control_points, points, weights).dense();
  expect_feasible<Dim>(control_points, points, weights);
  for (int k = 0; k < 50; ++k) {
    std::vector<int> support;
    for (int i = 0; i < 250; ++i) {
      if (weights(i, k) > 0) support.push_back(i);
    }
    ASSERT_GT(support.size(), Dim + 1);
    ASSERT_LT(support.size(), 250);
    const Eigen::VectorXd change = weights.col(k) - rows.col(k);
    const Eigen::VectorXd multipliers =
        least_squares(constraints(support, Eigen::all), change(support));
    const Eigen::VectorXd excess = change - constraints * multipliers;
    EXPECT_GE(excess.minCoeff(), -1e-12);
    EXPECT_LE(excess(support).maxCoeff(), 1e-12);
  }
}

TEST_IN_2D_AND_3D(NonNegativeTest, FeasibleColumnsAndColumnsNotAskedForStay) {
  Numbers numbers(17);
  const PointList<Dim> control_points = lattice<Dim>(3);
  const auto n = control_points.cols();
  WeightMatrix weights(n, 3);
  for (int k = 0; k < 3; ++k) weights.col(k) = numbers.convex(n);
  weights(0, 0) = 0;
  weights.col(0) /= weights.col(0).sum();
  weights(0, 0) = -0.0;
  const PointList<Dim> points = control_points * weights;
  weights(0, 1) = -5;
  weights(1, 2) = std::numeric_limits<double>::quiet_NaN();
  const WeightMatrix before = weights;
  weights =
      project_non_negative<Dim>(control_points, points, weights, std::vector<Index>{0}).dense();
  EXPECT_TRUE(bit_equal(weights.rightCols(2), before.rightCols(2)));
  EXPECT_TRUE(
      bit_equal(weights.bottomRows(n - 1).leftCols(1), before.bottomRows(n - 1).leftCols(1)));
  EXPECT_FALSE(std::signbit(weights(0, 0)));

  weights =
      project_non_negative<Dim>(control_points, points, weights, std::vector<Index>{1}).dense();
  EXPECT_TRUE(bit_equal(weights.col(2), before.col(2)));
  EXPECT_GE(weights.col(1).minCoeff(), 0);
}

TEST_IN_2D_AND_3D(NonNegativeTest, PointsOutsideAreNamed) {
  const PointList<Dim> control_points = 10 * lattice<Dim>(3);
  const double size = bounding_box_diagonal<Dim>(control_points);
  PointList<Dim> points = PointList<Dim>::Constant(Dim, 400, 5);
  points(0, 5) = 10 + 0.5e-6 * size;
  points(0, 123) = 10.25;
  points(0, 321) = -1;
  const WeightMatrix rows = WeightMatrix::Constant(control_points.cols(), 400, -1);
  auto weights = rows;
  const auto refused = [&](std::initializer_list<std::string> pieces) {
    expect_error<InputError>(
        [&] { return project_non_negative<Dim>(control_points, points, weights); }, pieces);
  };
  refused({"point 123", "(10.25, 5", "by 0.25"});
  const double inf = std::numeric_limits<double>::infinity();
  weights(2, 7) = inf;
  refused({"point 7", "(5, 5"});
  weights = rows;
  points(0, 123) = inf;
  refused({"point 123"});
  const std::vector<Index> absent{400};
  expect_refused(
      "400", [&] { return project_non_negative<Dim>(control_points, points, weights, absent); });
  points.conservativeResize(Dim, 300);
  refused({"300", "400"});
  points(0, 123) = 10 + 2e-6 * size;
  weights.conservativeResize(control_points.cols(), 300);
  refused({"point 123"});
  points(0, 123) = 10 + 0.5e-6 * size;
  weights = project_non_negative<Dim>(control_points, points, weights).dense();
  EXPECT_LE((control_points * weights.col(123) - points.col(123)).norm(), 0.6e-6 * size);
}

TEST_IN_2D_AND_3D(NonNegativeTest, ThreadsDoNotMatter) {
  Numbers numbers(19);
  const PointList<Dim> control_points = numbers.matrix(Dim, 30, -1, 1);
  const auto points = awkward_points<Dim>(control_points, numbers, 1000);
  const auto rows = awkward_rows(30, 1000, numbers);
  expect_same_for_any_threads(
      [&] { return project_non_negative<Dim>(control_points, points, rows).dense(); });
}

// The nearest point of a hull: h with (x - h) . (c - h) <= 0 for all c.
TEST_IN_2D_AND_3D(NonNegativeTest, NearestPointOfTheHull) {
  for (const auto& [name, control_points] : awkward_control_points<Dim>()) {
    SCOPED_TRACE(name);
    Numbers numbers(23);
    const double size = bounding_box_diagonal<Dim>(control_points);
    for (int k = 0; k < 100; ++k) {
      const Vector<Dim> query =
          control_points.rowwise().mean() +
          Vector<Dim>(numbers.matrix(Dim, 1, -size, size) * (k % 2 == 0 ? 1 : 0.2));
      const auto nearest = nearest_point_in_hull<Dim>(control_points, query);
      const Vector<Dim> normal = query - nearest.point;
      EXPECT_NEAR(normal.norm(), nearest.distance, 1e-12 * size);
      const PointList<Dim> offsets = control_points.colwise() - nearest.point;
      EXPECT_LE((normal.transpose() * offsets).maxCoeff(), 1e-12 * size * size);
      double sum = 0;
      Vector<Dim> combination = Vector<Dim>::Zero();
      for (int m = 0; m < nearest.size; ++m) {
        EXPECT_GT(nearest.weights[m], 0);
        sum += nearest.weights[m];
        combination += nearest.weights[m] * control_points.col(nearest.support[m]);
      }
      EXPECT_NEAR(sum, 1, 1e-14);
      EXPECT_LE((combination - nearest.point).norm(),
                1e-14 * (size + control_points.cwiseAbs().maxCoeff()));
    }
  }
}

}  // namespace
}  // namespace flbc::testing
