// SPDX-License-Identifier: BSD-3-Clause
// A smooth end of the deformation where a mesh passes through its cage.
#include "flbc/errors.h"
#include "support/box_column.h"
#include "support/test.h"

namespace flbc::testing {
namespace {

// The formulas of the issue, written anew.
double expected_factor(double mass, const Joint& joint) {
  const double t = std::min(1.0, mass / joint.mass);
  return joint.is_curvature ? 6 * t * t - 8 * t * t * t + 3 * t * t * t * t : 2 * t - t * t;
}

template <int Dim>
struct JointTest {
  Binding<Dim> binding = box_column<Dim>();
  PointList<Dim> pose = with_moved_side<Dim>(binding.cage);
};

TEST_IN_2D_AND_3D(JointTest, SlowsTheDisplacementByTheMassThatMoves) {
  JointTest<Dim> t;
  const auto& rest = t.binding.points;
  const PointList<Dim> moves = t.binding.deform(t.pose) - rest;
  for (const Joint joint : {Joint{}, Joint{0.3, true}, Joint{1, false}}) {
    const auto joined = t.binding.joined(joint);
    EXPECT_EQ(static_cast<int>(joined.held.size()), 1 << (Dim - 1));
    validate(joined);
    const PointList<Dim> slowed = joined.deform(t.pose) - rest;
    for (Index p = 0; p < rest.cols(); ++p) {
      const double mass = std::max(0.0, (rest(0, p) + 1) / 2);
      const auto expected = expected_factor(mass, joint) * moves.col(p);
      EXPECT_LT((slowed.col(p) - expected).norm(), 1e-14) << p << ' ' << joint.mass;
      const double sum = joined.weights.at(p).sum();
      EXPECT_NEAR(sum, rest(0, p) < -1 ? 0 : 1, 1e-14);
    }
  }
}

TEST_IN_2D_AND_3D(JointTest, ValueAndSlopeVanishAtTheBorder) {
  JointTest<Dim> t;
  const Index layer = Dim == 2 ? 3 : 9, first = 10 * layer;  // 0.025 inside
  ASSERT_NEAR(t.binding.points(0, first), -0.975, 1e-12);
  const auto slope = [&](const Binding<Dim>& binding) {
    return (binding.deform(t.pose) - binding.rest()).col(first).norm() / 0.025;
  };
  const double before = slope(t.binding);
  EXPECT_GT(before, 0.1);
  EXPECT_LT(slope(t.binding.joined({0.5, false})), 0.1 * before);
  EXPECT_LT(slope(t.binding.joined({0.5, true})), 0.01 * before);
}

TEST_IN_2D_AND_3D(JointTest, RestAndOutsideStayToTheBit) {
  JointTest<Dim> t;
  EXPECT_EQ(t.binding.deform(t.binding.cage.points), t.binding.points);
  const auto joined = t.binding.joined({});
  EXPECT_EQ(joined.deform(joined.cage.points), joined.rest());
  EXPECT_LT((joined.rest() - t.binding.points).cwiseAbs().maxCoeff(), 1e-15);
  const auto moved = joined.deform(t.pose);
  for (Index p = 0; p < moved.cols() && t.binding.points(0, p) < -1; ++p) {
    EXPECT_EQ(moved.col(p), t.binding.points.col(p));
  }
}

TEST_IN_2D_AND_3D(JointTest, RefusesWhatItCannotKeep) {
  JointTest<Dim> t;
  auto pose = t.pose;
  pose(1, 0) += 0.25;
  const auto joined = t.binding.joined({});
  expect_error<InputError>([&] { joined.deform(pose); }, {"control point 0 is held", "0.25"});
  expect_error<InputError>([&] { joined.composed({}, t.binding.cage); }, {"has a joint"});
  expect_error<OptionError>([&] { t.binding.joined({0, false}); }, {"mass"});
  auto inside = t.binding;
  inside.edges = {};
  expect_error<InputError>([&] { inside.joined({}); }, {"passes through the cage"});
}

TEST(ParseJoint, ReadsNamesAndMasses) {
  EXPECT_EQ(parse_joint("smooth").mass, 0.5);
  EXPECT_FALSE(parse_joint("smooth").is_curvature);
  EXPECT_EQ(parse_joint("curvature:0.25").mass, 0.25);
  EXPECT_TRUE(parse_joint("curvature:0.25").is_curvature);
  for (const char* text : {"", "sharp", "smooth:", "smooth:x", "smooth:0.3x", "smooth "}) {
    expect_error<OptionError>([&] { parse_joint(text); }, {"smooth:0.3"});
  }
}

}  // namespace
}  // namespace flbc::testing
