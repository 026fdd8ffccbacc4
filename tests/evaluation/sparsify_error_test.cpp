// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/sparsify_error.h"
#include "flbc/poses.h"
#include "flbc/sparsify.h"
#include "support/feasible_vertices.h"

namespace flbc::testing {
namespace {

TEST_IN_2D_AND_3D(SparsifyErrorTest, InfluencesNormsAndPoses) {
  Numbers numbers(14);
  const PointList<Dim> control_points = numbers.matrix(Dim, 4, -1, 1);
  WeightMatrix before = WeightMatrix::Zero(4, 2), after = before;
  before.row(0).setOnes();
  after(0, 0) = after(1, 1) = 1;
  EXPECT_EQ(count_influences(after).mean, 1);
  EXPECT_EQ(count_influences(WeightMatrix(before + after)).max, 2);
  EXPECT_EQ(count_influences(WeightMatrix(1e-5 * before + after)).max, 2);
  EXPECT_EQ(count_influences(WeightMatrix(1e-5 * before + after), kInfluenceThreshold).max, 1);
  EXPECT_EQ(weight_error(before, after).max, 1);
  EXPECT_DOUBLE_EQ(weight_error(before, after).rms, 0.5);  // two of eight differ by 1
  const double distance = (control_points.col(0) - control_points.col(1)).norm();
  const auto error = deformation_error<Dim>({control_points}, before, after);
  EXPECT_DOUBLE_EQ(error.max, distance);
  EXPECT_DOUBLE_EQ(error.rms, distance / std::sqrt(2));
  EXPECT_THROW(weight_error(before, WeightMatrix(after.leftCols(1))), InputError);
  EXPECT_THROW(deformation_error<Dim>({control_points.leftCols(3)}, before, after), InputError);

  const double size = bounding_box_diagonal<Dim>(control_points);
  const auto poses = independent_poses<Dim>(control_points, 3);
  ASSERT_EQ(poses.size(), 3);
  EXPECT_NE(poses[0], poses[1]);
  for (const auto& pose : poses) {
    for (int i = 0; i < 4; ++i) {
      EXPECT_NEAR((pose - control_points).col(i).norm(), 0.1 * size, 1e-12);
    }
  }
  for (const auto& pose : smooth_poses<Dim>(control_points, 3)) {
    EXPECT_GT((pose - control_points).norm(), 1e-3 * size);
    EXPECT_LT((pose - control_points).colwise().norm().maxCoeff(), size);
  }
}

}  // namespace
}  // namespace flbc::testing
