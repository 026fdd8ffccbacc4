// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/sparsify.h"

#include <fstream>

#include "flbc/non_negative.h"
#include "flbc/poses.h"
#include "support/model_cages.h"
#include "support/poisson_problem.h"

namespace flbc::testing {
namespace {

TEST_IN_2D_AND_3D(SparsifyTest, KeepsTheConstraintsWhateverComes) {
  Numbers numbers(7);
  for (const auto& [name, control_points] : awkward_control_points<Dim>()) {
    SCOPED_TRACE(name);
    const auto points = awkward_points<Dim>(control_points, numbers, 60);
    const auto n = control_points.cols();
    for (const double low : {0.0, -1.0}) {
      WeightMatrix weights = numbers.matrix(n, points.cols(), low, 1);
      for (auto column : weights.colwise()) column /= column.cwiseAbs().sum();
      for (const Index most : {Dim + 1, Dim + 3}) {
        SCOPED_TRACE(most);
        const auto sparse = sparsify<Dim>(control_points, points, weights, at_most(most)).dense();
        expect_sparse_coordinates<Dim>(control_points, points, sparse, most);
        EXPECT_EQ(sparsify<Dim>(control_points, points, sparse, at_most(most)).dense(), sparse);
        EXPECT_EQ(
            sparsify<Dim>(control_points, points, SparseWeights(weights), at_most(most)).dense(),
            sparse);
      }
      const auto dropped = sparsify<Dim>(control_points, points, weights, at_most(8, 0.05)).dense();
      expect_sparse_coordinates<Dim>(control_points, points, dropped, 8);
    }
  }
}

TEST_IN_2D_AND_3D(SparsifyTest, WithoutLimitItIsTheProjection) {
  Numbers numbers(8);
  const PointList<Dim> control_points = numbers.matrix(Dim, 20, -1, 1);
  const auto points = awkward_points<Dim>(control_points, numbers, 40);
  const WeightMatrix weights = numbers.matrix(20, 40, -0.2, 0.3);
  const WeightMatrix projected = project_non_negative<Dim>(control_points, points, weights).dense();
  EXPECT_GT((weights - projected).norm(), 0.1);
  EXPECT_EQ(sparsify<Dim>(control_points, points, weights, at_most(20)).dense(), projected);
  EXPECT_EQ(sparsify<Dim>(control_points, points, weights, {}).dense(), projected);
}

TEST_IN_2D_AND_3D(SparsifyTest, IsNearTheBestOfAllSupports) {
  constexpr int kControls = 9, kPoints = 40;
  const Eigen::MatrixXd identity = Eigen::MatrixXd::Identity(kControls, kControls);
  Numbers numbers(9);
  for (const Index most : {Dim + 1, Dim + 2, Dim + 3}) {
    SCOPED_TRACE(most);
    int best = 0;
    double total = 0, least_total = 0;
    const PointList<Dim> control_points = numbers.matrix(Dim, kControls, -1, 1);
    PointList<Dim> points(Dim, kPoints);
    WeightMatrix weights(kControls, kPoints);
    for (int v = 0; v < kPoints; ++v) {
      weights.col(v) = numbers.convex(kControls);
      weights.col(v) /= weights.col(v).sum();
      points.col(v) = control_points * weights.col(v);
    }
    const auto sparse = sparsify<Dim>(control_points, points, weights, at_most(most)).dense();
    expect_sparse_coordinates<Dim>(control_points, points, sparse, most);
    for (int v = 0; v < kPoints; ++v) {
      const double cost = (sparse.col(v) - weights.col(v)).squaredNorm();
      const Eigen::VectorXd nearest =
          nearest_row<Dim>(identity, control_points, points.col(v), weights.col(v), most);
      const double least = (nearest - weights.col(v)).squaredNorm();
      EXPECT_GE(cost, least - 1e-12) << v;  // the reference is correct
      best += cost <= least + 1e-9;
      total += cost;
      least_total += least;
    }
    EXPECT_GE(best, 3 * kPoints / 4);
    EXPECT_LE(total, 1.1 * least_total + 1e-9);
  }
}

TEST_IN_2D_AND_3D(SparsifyTest, MatchesTheOptimumOfItsOwnSupport) {
  Numbers numbers(10);
  const PointList<Dim> control_points = numbers.matrix(Dim, 30, -1, 1);
  const auto points = awkward_points<Dim>(control_points, numbers, 40);
  const WeightMatrix weights = numbers.matrix(30, 40, -0.1, 0.2);
  const auto sparse = sparsify<Dim>(control_points, points, weights, at_most(6)).dense();
  for (int v = 0; v < 40; ++v) {
    std::vector<Index> support;
    for (Index i = 0; i < 30; ++i) {
      if (sparse(i, v) != 0) support.push_back(i);
    }
    if (support.size() == 1) continue;  // the point may be beside it by a rounding error
    WeightMatrix few = weights.col(v)(support);
    few =
        project_non_negative<Dim>(control_points(Eigen::all, support), points.col(v), few).dense();
    EXPECT_LE((few.col(0) - sparse.col(v)(support)).norm(), 1e-12) << v;
  }
}

TEST_IN_2D_AND_3D(SparsifyTest, LocalBarycentricCoordinates) {
  const auto sample = make_sample<Dim>(Shape::kRing, Dim == 2 ? 6 : 3, 0.1);
  const auto solution = solve(sample.cage, sample.mesh, {});
  const auto& points = sample.mesh.points;
  ASSERT_GT(count_influences(solution.weights.dense()).max, Dim + 2);
  const auto poses = independent_poses<Dim>(sample.cage.points, 10);
  double before = std::numeric_limits<double>::infinity();
  for (const Index most : {Dim + 1, Dim + 2, Dim + 4}) {
    const auto sparse =
        sparsify<Dim>(sample.cage.points, points, solution.weights.dense(), at_most(most)).dense();
    expect_sparse_coordinates<Dim>(sample.cage.points, points, sparse, most);
    const double error = deformation_error<Dim>(poses, solution.weights.dense(), sparse).rms;
    EXPECT_LT(error, before);  // more influences, less error
    before = error;
  }
  EXPECT_LT(before, 0.01 * bounding_box_diagonal<Dim>(points));
}

TEST_IN_2D_AND_3D(SparsifyTest, ThresholdDropsWhatIsBelow) {
  Numbers numbers(11);
  const PointList<Dim> control_points = numbers.matrix(Dim, 25, -1, 1);
  // Small weights everywhere, and large ones on Dim + 4 control points.
  WeightMatrix weights = numbers.matrix(25, 50, 1e-6, 1e-4);
  for (int v = 0; v < 50; ++v) {
    for (int k = 0; k < Dim + 4; ++k) weights((7 * k + v) % 25, v) = numbers.uniform(0.1, 1);
    weights.col(v) /= weights.col(v).sum();
  }
  const PointList<Dim> points = control_points * weights;
  SparsifyOptions options;
  options.threshold = 1e-3;
  const auto sparse = sparsify<Dim>(control_points, points, weights, options).dense();
  expect_sparse_coordinates<Dim>(control_points, points, sparse, Dim + 4);
  EXPECT_EQ(count_influences(sparse).mean, Dim + 4);
  EXPECT_LT(weight_error(weights, sparse).max, 0.05);
  // Above all weights it must keep as many as the point needs.
  options.threshold = 0.99;
  const auto few = sparsify<Dim>(control_points, points, weights, options).dense();
  expect_sparse_coordinates<Dim>(control_points, points, few, 25);
  EXPECT_LT(count_influences(few).mean, Dim + 4);
}

TEST_IN_2D_AND_3D(SparsifyTest, TellsHowFarItIs) {
  Numbers numbers(12);
  const PointList<Dim> control_points = numbers.matrix(Dim, 25, -1, 1);
  const auto points = awkward_points<Dim>(control_points, numbers, 400);
  const WeightMatrix weights = numbers.matrix(25, 400, -0.1, 0.2);
  const auto expected = sparsify<Dim>(control_points, points, weights, at_most(5)).dense();
  for (const int threads : {1, 2}) {
    const ThreadScope scope(threads);
    std::vector<double> reported;
    auto options = at_most(5);
    options.progress = [&](double done) { reported.push_back(done); };
    EXPECT_EQ(sparsify<Dim>(control_points, points, weights, options).dense(), expected);
    ASSERT_FALSE(reported.empty());
    EXPECT_TRUE(std::is_sorted(reported.begin(), reported.end()));
    EXPECT_GT(reported.front(), 0);
    EXPECT_EQ(reported.back(), 1);
  }
}

TEST_IN_2D_AND_3D(SparsifyTest, RefusesWhatCannotBe) {
  Numbers numbers(13);
  const PointList<Dim> control_points = numbers.matrix(Dim, 10, -1, 1);
  PointList<Dim> points = awkward_points<Dim>(control_points, numbers, 3);
  const WeightMatrix weights = numbers.matrix(10, 3, 0, 1);
  const auto run = [&](const SparsifyOptions& options, const WeightMatrix& any) {
    return sparsify<Dim>(control_points, points, any, options).dense();
  };
  EXPECT_NO_THROW(run(at_most(Dim + 1), weights));
  expect_error<OptionError>([&] { run(at_most(Dim), weights); },
                            {"at least " + std::to_string(Dim + 1) + " in "});
  expect_error<OptionError>([&] { run(at_most(8, 1), weights); }, {"threshold"});
  expect_error<OptionError>([&] { run(at_most(8, std::nan("")), weights); }, {"threshold"});
  expect_error<InputError>([&] { run(at_most(8), numbers.matrix(9, 3, 0, 1)); },
                           {"9 control points do not match"});
  expect_error<InputError>([&] { run(at_most(8), numbers.matrix(10, 4, 0, 1)); }, {"4 points"});
  points.col(1).setConstant(5);
  expect_error<InputError>([&] { run(at_most(8), weights); }, {"point 1 at (5, 5"});
}

TEST(ForeignWeights, OfTheArm) {
  if (!has_model("3d/arm_other_weights.txt")) GTEST_SKIP() << "the real models are absent";
  const auto control_points = load_cage<3>("3d/arm_cage.obj").points;
  const auto points = load_cage<3>("3d/arm.obj").points;
  WeightMatrix given = WeightMatrix::Zero(control_points.cols(), points.cols());
  std::ifstream file(model_path("3d/arm_other_weights.txt"));
  for (Eigen::Index i = 0, p = 0; file >> i >> p;) file >> given(i, p);
  EXPECT_EQ((given.array() < 0).count(), 23675);
  const auto poses = smooth_poses<3>(control_points, 5);
  for (const Index most : {4, 8}) {
    const auto sparse = sparsify<3>(control_points, points, given, at_most(most)).dense();
    expect_sparse_coordinates<3>(control_points, points, sparse, most);
    EXPECT_LT(deformation_error<3>(poses, given, sparse).rms,
              0.005 * bounding_box_diagonal<3>(points));
  }
}

}  // namespace
}  // namespace flbc::testing
