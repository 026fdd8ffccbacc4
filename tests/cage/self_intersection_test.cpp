// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/meshing.h"
#include "support/model_cages.h"

namespace flbc::testing {
namespace {

bool mentions(const Defect& defect, const std::string& text) {
  return defect.message.find(text) != std::string::npos;
}

TEST_IN_2D_AND_3D(SelfIntersectionTest, SoundCagesHaveNone) {
  const Cage<Dim> box = box_cage<Dim>(1);
  EXPECT_TRUE(find_self_intersections(box).empty());
  EXPECT_TRUE(find_self_intersections(join(box, box_cage<Dim>(0.999999))).empty());
}

TEST_IN_2D_AND_3D(SelfIntersectionTest, OverlappingBoxes) {
  const Cage<Dim> box = box_cage<Dim>(1);
  Cage<Dim> shifted = box;
  for (int axis = 0; axis < Dim; ++axis) {
    shifted.points.row(axis).array() += axis == 0 ? 0.5 : 0.25 * axis;
  }
  const Cage<Dim> both = join(box, shifted);
  const std::vector<Defect> defects = find_self_intersections(both, 1000);
  ASSERT_GE(defects.size(), 2u);
  for (const Defect& defect : defects) {
    ASSERT_EQ(defect.facets.size(), 2u);
    EXPECT_LT(defect.facets[0], box.facets.cols());  // one of either box
    EXPECT_GE(defect.facets[1], box.facets.cols());
    EXPECT_TRUE(mentions(
        defect, std::to_string(defect.facets[0]) + " and " + std::to_string(defect.facets[1])));
  }
  const auto first = find_self_intersections(both, 1);
  ASSERT_EQ(first.size(), 1u);
  EXPECT_EQ(first[0].facets, defects[0].facets);
}

TEST_IN_2D_AND_3D(SelfIntersectionTest, CornerOnAFacetTouches) {
  // An inner simplex whose last corner lies exactly on the side x = 1.
  Cage<Dim> cage = box_cage<Dim>(1);
  Cage<Dim> inner;
  inner.points = PointList<Dim>::Zero(Dim, Dim + 1);
  for (int k = 1; k < Dim; ++k) inner.points(k, k) = 0.5;
  inner.points(0, Dim) = 1;
  inner.points(1, Dim) = 0.25;
  inner.facets.resize(Dim, Dim + 1);
  if constexpr (Dim == 2) {
    inner.facets << 0, 1, 2, 1, 2, 0;
  } else {
    inner.facets << 0, 0, 0, 1, 1, 2, 3, 3, 2, 3, 1, 2;
  }
  const std::vector<Defect> defects = find_self_intersections(join(cage, inner));
  EXPECT_FALSE(defects.empty());
  EXPECT_TRUE(mentions(defects.front(), "(1, 0.25"));
}

TEST(SelfIntersection2Test, FigureOfEightNamesEdgesAndPlace) {
  PointList<2> points{{0, 2, 2, 0}, {0, 2, 0, 2}};
  const std::vector<Defect> defects = find_self_intersections(loop(points));
  ASSERT_EQ(defects.size(), 1u);
  EXPECT_EQ(defects[0].facets, (std::vector<Index>{0, 2}));
  EXPECT_TRUE(mentions(defects[0], "(1, 1)"));
}

TEST(SelfIntersection2Test, EdgeThatRunsBackAlongItsNeighbour) {
  PointList<2> points{{0, 4, 2, 2, 0}, {0, 0, 0, 3, 3}};
  const std::vector<Defect> defects = find_self_intersections(loop(points));
  ASSERT_FALSE(defects.empty());
  EXPECT_TRUE(mentions(defects[0], "near (3, 0)"));
}

TEST(SelfIntersection3Test, FoldedNeighbours) {
  // Corner 7 of the box goes through the side z = -1.
  Cage<3> cage = box_cage<3>(1);
  cage.points.col(7) << 0, 0.1, -3;
  EXPECT_FALSE(find_self_intersections(cage).empty());
}

TEST(SelfIntersection3Test, PlaceLiesOnBothTriangles) {
  // Two tall boxes cross at right angles: they meet on the planes |x| = 1 or |y| = 0.5.
  const Cage<3> cage = join(box_cage<3>(Vector<3>(-1, -2, -1), Vector<3>(1, 2, 1)),
                            box_cage<3>(Vector<3>(-3, -0.5, -0.5), Vector<3>(3, 0.5, 0.5)));
  const std::vector<Defect> defects = find_self_intersections(cage, 1000);
  ASSERT_FALSE(defects.empty());
  for (const Defect& defect : defects) {
    EXPECT_TRUE(mentions(defect, "near (1, ") || mentions(defect, "near (-1, ")) << defect.message;
  }
}

TEST(SelfIntersectionRealTest, RealCages) {
  if (!has_model("defective/self_intersecting_cage.obj")) {
    GTEST_SKIP() << "the real models are absent";
  }
  for (const char* name : {"self_intersecting_cage.obj", "genus1_self_intersecting_cage.obj"}) {
    EXPECT_FALSE(find_self_intersections(load_cage<3>("defective/" + std::string(name))).empty());
  }
  for (const auto* name : kRealCages2D) {
    EXPECT_TRUE(find_self_intersections(load_cage<2>(name)).empty());
  }
  for (const auto* name : kRealCages3D) {
    EXPECT_TRUE(find_self_intersections(load_cage<3>(name)).empty());
  }
}

}  // namespace
}  // namespace flbc::testing
