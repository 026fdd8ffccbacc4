// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/deform.h"

#include "support/test.h"

namespace flbc {
namespace {

template <int Dim>
struct Deform {
  static constexpr Index kControlPoints = 7;

  // Weights that sum to 1, half of them zero; some are negative.
  static WeightMatrix make_weights(Index num_points) {
    WeightMatrix weights = WeightMatrix::Zero(kControlPoints, num_points);
    for (Index p = 0; p < num_points; ++p) {
      double sum = 0;
      for (Index i = p % 2; i < kControlPoints; i += 2) {
        weights(i, p) = std::sin(1.0 + 3 * i + 0.37 * p);
        if (i + 2 < kControlPoints) sum += weights(i, p);
      }
      weights(p % 2 == 0 ? 6 : 5, p) = 1 - sum;
    }
    return weights;
  }

  static PointList<Dim> make_pose() {
    PointList<Dim> pose(Dim, kControlPoints);
    for (Index k = 0; k < pose.size(); ++k) pose(k % Dim, k / Dim) = std::cos(2.0 + 5 * k);
    return pose;
  }
};

TEST_IN_2D_AND_3D(Deform, SumsWeightsTimesControlPoints) {
  const Index num_points = 5003;
  const auto weights = Deform<Dim>::make_weights(num_points);
  const auto pose = Deform<Dim>::make_pose();
  const PointList<Dim> moved = deform(weights, pose);
  ASSERT_EQ(moved.cols(), num_points);
  for (Index p = 0; p < num_points; ++p) {
    Vector<Dim> expected = Vector<Dim>::Zero();
    for (Index i = 0; i < pose.cols(); ++i) expected += weights(i, p) * pose.col(i);
    ASSERT_NEAR((moved.col(p) - expected).norm(), 0, 1e-14) << p;
  }
}

TEST_IN_2D_AND_3D(Deform, ThreadsChangeNoBit) {
  // Seven weights each, half of them zero: more than one thread takes.
  const SparseWeights weights(Deform<Dim>::make_weights(1'200'000));
  const auto pose = Deform<Dim>::make_pose();
  const PointList<Dim> alone = deform(weights, pose, 1);
  for (const int threads : {0, 2, 3}) EXPECT_EQ(deform(weights, pose, threads), alone) << threads;
}

TEST_IN_2D_AND_3D(Deform, MeasuresDisplacements) {
  const PointList<Dim> pose = Deform<Dim>::make_pose();
  PointList<Dim> moved = pose;
  moved(0, 2) += 3;
  moved(1, 2) -= 4;
  const auto lengths = displacements(pose, moved);
  EXPECT_NEAR(lengths[2], 5, 1e-14);
  EXPECT_NEAR(lengths.sum(), 5, 1e-14);
  EXPECT_THROW(displacements(pose, PointList<Dim>(Dim, 3)), InputError);
}

TEST_IN_2D_AND_3D(Deform, RefusesPosesOfAnotherCage) {
  const auto weights = Deform<Dim>::make_weights(4);
  const PointList<Dim> pose = PointList<Dim>::Zero(Dim, 8);
  const std::string words = "the weights are for 7 control points, but the pose has 8";
  testing::expect_refused(words, [&] { deform(weights, pose); });
  EXPECT_EQ(deform(WeightMatrix(8, 0), pose).cols(), 0);
}

TEST(SparseWeights, KeepWhatIsAboveTheThresholdBitByBit) {
  WeightMatrix weights(3, 4);
  weights << 0.1, 0, 0, 1e-5,  //
      -0.3, 1, 0, -1e-5,       //
      1.2, 0, 0, 1;
  const SparseWeights all(weights);
  EXPECT_EQ(all.num_points(), 4);
  EXPECT_EQ(all.num_control_points(), 3);
  EXPECT_EQ(all.starts(), (std::vector<std::int64_t>{0, 3, 4, 4, 7}));
  EXPECT_EQ(all.control_points(), (std::vector<std::uint32_t>{0, 1, 2, 1, 0, 1, 2}));
  EXPECT_EQ(all.values(), (std::vector<double>{0.1, -0.3, 1.2, 1, 1e-5, -1e-5, 1}));
  const SparseWeights large(weights, 0.1);  // not above, but at the threshold: dropped
  EXPECT_EQ(large.starts(), (std::vector<std::int64_t>{0, 2, 3, 3, 4}));
  EXPECT_EQ(large.values(), (std::vector<double>{-0.3, 1.2, 1, 1}));
  EXPECT_EQ(SparseWeights().num_points(), 0);
  EXPECT_THROW(SparseWeights(weights, -1), OptionError);
  EXPECT_THROW(SparseWeights(weights, std::nan("")), OptionError);
}

TEST(SparseWeights, GiveBackTheMatrixTheyWereMadeOf) {
  WeightMatrix weights = WeightMatrix::Random(7, 3000);
  weights = (weights.array() > 0.2).select(weights, 0);
  const SparseWeights sparse(weights);
  EXPECT_EQ(sparse.dense(), weights);
  EXPECT_EQ(sparse.at(17), weights.col(17));
  const SparseWeights same(7, sparse.starts(), sparse.control_points(), sparse.values());
  EXPECT_EQ(same.dense(), weights);
}

TEST(SparseWeights, RefusePartsThatDoNotFit) {
  EXPECT_NO_THROW(SparseWeights(3, {0, 2, 2, 3}, {0, 2, 1}, {0.5, 0.5, 1}));
  EXPECT_THROW(SparseWeights(3, {}, {}, {}), InputError);
  EXPECT_THROW(SparseWeights(-1, {0}, {}, {}), InputError);
  EXPECT_THROW(SparseWeights(3, {1, 3}, {0, 2, 1}, {0.5, 0.5, 1}), InputError);
  EXPECT_THROW(SparseWeights(3, {0, 2}, {0, 2, 1}, {0.5, 0.5, 1}), InputError);
  EXPECT_THROW(SparseWeights(3, {0, 3}, {0, 1}, {0.5, 0.5, 1}), InputError);
  EXPECT_THROW(SparseWeights(3, {0, 4, 3}, {0, 1, 2}, {0.5, 0.5, 1}), InputError);
  EXPECT_THROW(SparseWeights(3, {0, 2, 1, 3}, {0, 1, 2}, {0.5, 0.5, 1}), InputError);
  EXPECT_THROW(SparseWeights(3, {0, 3}, {0, 1, 3}, {0.5, 0.5, 1}), InputError);
  EXPECT_THROW(SparseWeights(3, {0, 2}, {1, 1}, {0.5, 0.5}), InputError);
  EXPECT_THROW(SparseWeights(3, {0, 2}, {0, 1}, {0.5, std::nan("")}), InputError);
}

}  // namespace
}  // namespace flbc
