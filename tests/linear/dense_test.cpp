// SPDX-License-Identifier: BSD-3-Clause
#include "linear/dense.h"

#include "support/test.h"

namespace flbc::dense {
namespace {

constexpr double kRounding = 1e-13;

// Columns that are far from orthogonal, but independent.
Eigen::MatrixXd columns_of(int rows, int cols) {
  Eigen::MatrixXd a(rows, cols);
  for (int i = 0; i < rows; ++i) {
    for (int j = 0; j < cols; ++j) a(i, j) = std::sin(1.0 + 2.3 * i + 0.7 * i * j) + (j == 0);
  }
  return a;
}

TEST_IN_2D_AND_3D(Dense, SolvesSymmetricSystems) {
  constexpr int kSize = Dim + 1;
  const Eigen::Matrix<double, kSize, kSize> factor = columns_of(kSize, kSize);
  const Eigen::Matrix<double, kSize, kSize> matrix = factor.transpose() * factor;
  const Eigen::Matrix<double, kSize, 1> right = columns_of(kSize, 1);
  EXPECT_LE((matrix * solve_symmetric<kSize>(matrix, right) - right).norm(), kRounding);
}

TEST_IN_2D_AND_3D(Dense, PrincipalAxesMakeAMatrixDiagonal) {
  using Square = Eigen::Matrix<double, Dim, Dim>;
  const Square factor = columns_of(Dim, Dim);
  const Square matrix = factor.transpose() * factor;
  for (const Square& symmetric : {matrix, Square(Square::Identity()), Square(Square::Zero())}) {
    const Square axes = principal_axes<Dim>(symmetric);
    EXPECT_LE((axes.transpose() * axes - Square::Identity()).norm(), kRounding);
    const Square turned = axes.transpose() * symmetric * axes;
    EXPECT_LE((turned - Square(turned.diagonal().asDiagonal())).norm(), kRounding);
  }
}

TEST_IN_2D_AND_3D(Dense, LeastSquaresLeavesAnOrthogonalRest) {
  const Eigen::MatrixXd a = columns_of(7, Dim);
  const Eigen::MatrixXd b = columns_of(7, 4);
  const Eigen::MatrixXd x = least_squares(a, b);
  EXPECT_LE((a.transpose() * (a * x - b)).norm(), kRounding * b.norm());
}

TEST_IN_2D_AND_3D(Dense, LeastSquaresHasTheLeastNorm) {
  Eigen::MatrixXd a = columns_of(7, Dim + 1);
  a.col(0) = a.col(1);  // any multiple of (1, -1, 0, ..) may be added
  const Eigen::VectorXd x = least_squares(a, columns_of(7, 1), 1e-13);
  EXPECT_NEAR(x[0], x[1], kRounding);
}

TEST_IN_2D_AND_3D(Dense, NormalEquationsAreSolvedWithoutSquaringTheCondition) {
  Eigen::MatrixXd a = columns_of(7, Dim);
  const Eigen::VectorXd wanted = columns_of(Dim, 1);
  a.col(0) = a.col(1) + 1e-6 * a.col(0);
  const Eigen::VectorXd x = solve_normal_equations(a, a.transpose() * (a * wanted));
  EXPECT_LE((a * (x - wanted)).norm(), 1e-9);
}

TEST_IN_2D_AND_3D(Dense, OrthonormalBasisSpansTheColumns) {
  const Eigen::MatrixXd a = columns_of(5, Dim);
  const Eigen::MatrixXd q = orthonormal_basis(a);
  ASSERT_EQ(q.cols(), a.cols());
  EXPECT_LE((q.transpose() * q - Eigen::MatrixXd::Identity(q.cols(), q.cols())).norm(), kRounding);
  EXPECT_LE((q * (q.transpose() * a) - a).norm(), kRounding * a.norm());
}

TEST_IN_2D_AND_3D(Dense, LeastPivotIsTheDistanceFromDependence) {
  Eigen::MatrixXd a = columns_of(9, Dim);
  EXPECT_GT(least_pivot(a), 0.1);
  a.col(0) = a.col(1);
  a(3, 0) += 1e-8;
  EXPECT_LE(least_pivot(a), 1.0001e-8);
  EXPECT_GE(least_pivot(a), 1e-9);
}

TEST(Rotations, NearestToARotationIsItself) {
  const Eigen::Matrix3d turn =
      Eigen::Quaterniond(0.5, -0.1, 0.7, 0.2).normalized().toRotationMatrix();
  EXPECT_LE((nearest_rotation(3 * turn) - turn).norm(), kRounding);
}

TEST(Rotations, NearestToAReflectionIsARotation) {
  const Eigen::Matrix3d mirror = Eigen::Vector3d(3, 2, -1).asDiagonal();
  const Eigen::Matrix3d turn = nearest_rotation(mirror);
  EXPECT_LE((turn - Eigen::Matrix3d::Identity()).norm(), kRounding);
}

}  // namespace
}  // namespace flbc::dense
