// SPDX-License-Identifier: BSD-3-Clause
// Where a grid passes through a box in it.
#include "flbc/border.h"

#include "flbc/cage_facts.h"
#include "support/test.h"

namespace flbc::testing {
namespace {

// A grid of unit cells from 0 to 6, and a box in it as a cage.
template <int Dim>
struct BorderTest {
  static constexpr Index kSide = 7;

  // \param low, high  of the box
  BorderTest(double low, double high) : cage(make_sample<Dim>(Shape::kBox, 2).cage) {
    const Vector<Dim> from = cage.points.rowwise().minCoeff();
    const Vector<Dim> extent = cage.points.rowwise().maxCoeff() - from;
    for (Index i = 0; i < cage.size(); ++i) {
      for (int d = 0; d < Dim; ++d) {
        cage.points(d, i) = low + (high - low) * (cage.points(d, i) - from[d]) / extent[d];
      }
    }
    const Index count = Dim == 2 ? kSide * kSide : kSide * kSide * kSide;
    points.resize(Dim, count);
    Index stride = 1;
    for (int d = 0; d < Dim; ++d, stride *= kSide) {
      for (Index p = 0; p < count; ++p) {
        points(d, p) = p / stride % kSide;
        if (p / stride % kSide + 1 < kSide) edges.ends.push_back({p, p + stride});
      }
    }
    is_still.assign(count, false);
    for (const Index p : points_outside(cage, points)) is_still[p] = true;
  }

  std::vector<BorderCrossing<Dim>> crossings() const {
    return find_crossings(cage, points, is_still, edges);
  }
  Vector<Dim> place_of(const BorderCrossing<Dim>& crossing) const {
    Vector<Dim> place = Vector<Dim>::Zero();
    for (int k = 0; k < Dim; ++k) {
      place += crossing.coordinates[k] * cage.points.col(cage.facets(k, crossing.facet));
    }
    return place;
  }

  Cage<Dim> cage;
  PointList<Dim> points;
  EdgeList edges;
  std::vector<bool> is_still;
};

TEST_IN_2D_AND_3D(BorderTest, EveryEdgeThatPassesThroughTheBoxIsFound) {
  for (const double low : {1.75, 2.0, 2.0 + 1e-7}) {  // between the lines of the grid and on them
    const BorderTest<Dim> t(low, 4.25);
    std::set<std::pair<Index, Index>> found;
    for (const auto& crossing : t.crossings()) {
      const auto [a, b] = crossing.ends;
      EXPECT_FALSE(t.is_still[a]);
      EXPECT_TRUE(t.is_still[b]);
      found.insert({std::min(a, b), std::max(a, b)});
      const auto place = t.place_of(crossing);
      const double length = (t.points.col(a) - t.points.col(b)).norm();
      EXPECT_NEAR((place - t.points.col(a)).norm() + (place - t.points.col(b)).norm(), length,
                  1e-5);
    }
    std::set<std::pair<Index, Index>> expected;
    for (const auto& [a, b] : t.edges.ends) {
      if (t.is_still[a] != t.is_still[b]) expected.insert({a, b});
    }
    EXPECT_GT(expected.size(), 0U);
    EXPECT_EQ(found, expected);
  }
}

TEST_IN_2D_AND_3D(BorderTest, TheJumpIsTheDisplacementOfTheCageThere) {
  const BorderTest<Dim> t(1.75, 4.25);
  const auto crossings = t.crossings();
  PointList<Dim> moved = PointList<Dim>::Zero(Dim, t.cage.size());
  EXPECT_EQ(largest_jump(t.cage, crossings, moved).length, 0);
  const Vector<Dim> shift = Vector<Dim>::LinSpaced(1, 2);
  moved.colwise() += shift;
  EXPECT_NEAR(largest_jump(t.cage, crossings, moved).length, shift.norm(), 1e-12);
  // An affine motion of the cage is linear on its facets.
  Eigen::Matrix<double, Dim, Dim> map = Eigen::Matrix<double, Dim, Dim>::Identity();
  map(0, Dim - 1) = 0.3;
  moved = map * t.cage.points;
  double expected = 0;
  for (const auto& crossing : crossings) {
    expected = std::max(expected, (map * t.place_of(crossing)).norm());
  }
  const auto jump = largest_jump(t.cage, crossings, moved);
  EXPECT_NEAR(jump.length, expected, 1e-12);
  EXPECT_NEAR((map * t.place_of(crossings[jump.crossing])).norm(), expected, 1e-12);
}

TEST_IN_2D_AND_3D(BorderTest, NothingJumpsIfTheControlPointsThereAreHeld) {
  const BorderTest<Dim> t(1.75, 4.25);
  const auto crossings = t.crossings();
  const auto held = control_points_at(t.cage, crossings);
  ASSERT_FALSE(held.empty());
  PointList<Dim> moved = PointList<Dim>::Ones(Dim, t.cage.size());
  for (const Index i : held) moved.col(i).setZero();
  EXPECT_LT(largest_jump(t.cage, crossings, moved).length, 1e-5);
  for (const Index i : held) {
    moved.col(i).setOnes();
    EXPECT_GT(largest_jump(t.cage, crossings, moved).length, 1e-5) << i;
    moved.col(i).setZero();
  }
}

TEST_IN_2D_AND_3D(BorderTest, ACageAroundAllHasNoBorder) {
  const BorderTest<Dim> t(-1, 7);
  EXPECT_TRUE(t.crossings().empty());
  EXPECT_EQ(largest_jump(t.cage, t.crossings(), t.cage.points).crossing, -1);
  EXPECT_TRUE(control_points_at(t.cage, t.crossings()).empty());
}

}  // namespace
}  // namespace flbc::testing
