// SPDX-License-Identifier: BSD-3-Clause
// Evaluator agrees with placement and deformation, in batches and from several threads.
#include "flbc/evaluator.h"

#include <thread>

#include "flbc/deform.h"
#include "flbc/poses.h"
#include "support/harmonic_weights.h"

namespace flbc::testing {
namespace {

template <int Dim>
struct EvaluatorTest {
  EvaluatorTest() {
    sample = make_sample<Dim>(Shape::kCorner, 4);
    size = bounding_box_diagonal<Dim>(sample.cage.points);
    weights = SparseWeights(harmonic_weights(sample));
    pose = smooth_poses<Dim>(sample.cage.points, 1).front();
    // Inside, on vertices of the mesh and of the cage, and outside.
    std::mt19937 random(7);
    std::uniform_real_distribution<double> part(-0.2, 1.2);
    const Vector<Dim> low = sample.cage.points.rowwise().minCoeff();
    const Vector<Dim> extent = sample.cage.points.rowwise().maxCoeff() - low;
    points.resize(Dim, 5000 + sample.mesh.points.cols());
    points.rightCols(sample.mesh.points.cols()) = sample.mesh.points;
    for (Index p = 0; p < 5000; ++p) {
      for (int d = 0; d < Dim; ++d) points(d, p) = low[d] + part(random) * extent[d];
    }
  }

  Evaluator<Dim> evaluator(OutsidePoints outside, int threads = 0) const {
    return {sample.cage, sample.mesh, weights, outside, threads};
  }

  Sample<Dim> sample;
  SparseWeights weights;
  PointList<Dim> pose, points;
  double size = 0;
};

constexpr OutsidePoints kPolicies[] = {OutsidePoints::kNearest, OutsidePoints::kKeep,
                                       OutsidePoints::kExtend};

// x + sum_i w_i (c'_i - c_i), whatever the policy. Points within the tolerance are on the cage.
TEST_IN_2D_AND_3D(EvaluatorTest, MovesPointsAsTheirWeightsDo) {
  const EvaluatorTest<Dim> t;
  for (const auto outside : kPolicies) {
    const auto placement = place_points(t.sample.cage, t.sample.mesh, t.points, outside);
    ASSERT_GT(placement.outside.size(), 100U);
    const auto weights = weights_at(t.sample.cage, t.sample.mesh, t.weights, placement);
    const PointList<Dim> expected = t.points + deform<Dim>(weights, t.pose - t.sample.cage.points);
    const auto evaluator = t.evaluator(outside);
    const auto placed = evaluator.place(t.points);
    const auto moved = evaluator.move(placed, evaluator.pose(t.pose));
    EXPECT_LT((moved - expected).colwise().norm().maxCoeff(), 1e-12 * t.size);
    EXPECT_LT((evaluator.weights(placed).dense() - weights.dense()).cwiseAbs().maxCoeff(), 1e-13);
  }
}

TEST_IN_2D_AND_3D(EvaluatorTest, DisplacementsGiveDisplacements) {
  const EvaluatorTest<Dim> t;
  for (const auto outside : kPolicies) {
    const auto evaluator = t.evaluator(outside);
    const auto placement = evaluator.place(t.points);
    const auto moved = evaluator.move(placement, evaluator.pose(t.pose));
    const auto shifts =
        evaluator.displace(placement, evaluator.pose(t.pose - t.sample.cage.points));
    EXPECT_LT((t.points + shifts - moved).cwiseAbs().maxCoeff(), 1e-12 * t.size);
  }
}

TEST_IN_2D_AND_3D(EvaluatorTest, RestAndTranslationsAtAndOutsideTheCage) {
  const EvaluatorTest<Dim> t;
  const Vector<Dim> shift = Vector<Dim>::LinSpaced(-3, 5) * t.size;
  for (const auto outside : kPolicies) {
    const auto evaluator = t.evaluator(outside);
    const auto placement = evaluator.place(t.points);
    const auto rest = evaluator.move(placement, evaluator.pose(t.sample.cage.points));
    EXPECT_LT((rest - t.points).cwiseAbs().maxCoeff(), 1e-12 * t.size);
    const PointList<Dim> pose = t.sample.cage.points.colwise() + shift;
    const auto moved = evaluator.move(placement, evaluator.pose(pose));
    PointList<Dim> expected = t.points.colwise() + shift;
    for (const auto& point : placement.outside) {
      if (outside == OutsidePoints::kKeep) expected.col(point.point) = t.points.col(point.point);
    }
    EXPECT_LT((moved - expected).cwiseAbs().maxCoeff(), 1e-12 * shift.norm());
  }
}

TEST_IN_2D_AND_3D(EvaluatorTest, BatchesAndThreadsChangeNothing) {
  const EvaluatorTest<Dim> t;
  for (const auto outside : kPolicies) {
    const auto evaluator = t.evaluator(outside, 2);
    const auto pose = evaluator.pose(t.pose);
    const auto expected = evaluator.move(evaluator.place(t.points), pose);
    PointList<Dim> moved(Dim, t.points.cols());
    std::vector<std::thread> threads;
    constexpr int kThreads = 3;
    for (int k = 0; k < kThreads; ++k) {
      threads.emplace_back([&, k] {
        for (Eigen::Index p = k * 97; p < t.points.cols(); p += kThreads * 97) {
          const auto count = std::min<Eigen::Index>(97, t.points.cols() - p);
          const PointList<Dim> batch = t.points.middleCols(p, count);
          moved.middleCols(p, count) = evaluator.move(evaluator.place(batch), pose);
        }
      });
    }
    for (auto& thread : threads) thread.join();
    EXPECT_TRUE((moved.array() == expected.array()).all());
  }
}

TEST_IN_2D_AND_3D(EvaluatorTest, RefusesPointsOutsideAndOtherSizes) {
  const EvaluatorTest<Dim> t;
  EXPECT_THROW(t.evaluator(OutsidePoints::kFail).place(t.points), InputError);
  EXPECT_THROW(t.evaluator(OutsidePoints::kFail).pose(t.pose.leftCols(3)), InputError);
  EXPECT_THROW((Evaluator<Dim>(t.sample.cage, t.sample.mesh, SparseWeights())), InputError);
}

}  // namespace
}  // namespace flbc::testing
