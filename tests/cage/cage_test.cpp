// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/cage.h"

#include "support/model_cages.h"

namespace flbc::testing {
namespace {

// True if some defect's message has all the pieces and concerns all the vertices.
::testing::AssertionResult reports(const std::vector<Defect>& defects,
                                   const std::vector<std::string>& pieces,
                                   const std::vector<Index>& vertices = {}) {
  std::string all;
  for (const Defect& defect : defects) {
    bool fits = true;
    for (const std::string& piece : pieces) {
      fits = fits && defect.message.find(piece) != std::string::npos;
    }
    for (Index vertex : vertices) {
      fits = fits && std::count(defect.vertices.begin(), defect.vertices.end(), vertex) == 1;
    }
    if (fits) return ::testing::AssertionSuccess();
    all += "\n  " + defect.message;
  }
  return ::testing::AssertionFailure() << "no such defect among:" << all;
}

TEST_IN_2D_AND_3D(CageTest, SoundCagesHaveNoDefects) {
  const Cage<Dim> box = box_cage<Dim>(1);
  const Cage<Dim> with_hole = join(box, box_cage<Dim>(0.25));
  for (const Cage<Dim>& cage :
       {box, reversed(box), with_hole, join(box, reversed(box_cage<Dim>(0.5)))}) {
    EXPECT_TRUE(find_defects(cage).empty());
    EXPECT_NO_THROW(validate(cage));
  }
  Cage<Dim> tiny = box;
  tiny.points *= 1e-12;  // tolerances are relative to the cage
  EXPECT_TRUE(find_defects(tiny).empty());
}

TEST_IN_2D_AND_3D(CageTest, ExtremeExtent) {
  const auto scaled = [](double factor, double shift) {
    Cage<Dim> cage = box_cage<Dim>(1);
    cage.points = (factor * cage.points).array() + shift;
    return find_defects(cage);
  };
  for (const double factor : {1e-320, 1e-150, 1e-40, 1e40, 1e150, 1e300}) {
    EXPECT_TRUE(reports(scaled(factor, 0), {"size", "out of range", "unit of length"})) << factor;
  }
  for (const double factor : {1e-29, 1e29}) EXPECT_TRUE(scaled(factor, 0).empty()) << factor;
  EXPECT_TRUE(scaled(1, 1e8).empty());
  EXPECT_TRUE(reports(scaled(1, 1e12), {"too far from the origin", "control point 0 at"}));
  EXPECT_TRUE(reports(scaled(1e-6, -1e5), {"too far from the origin", "control point 0 at"}));
}

TEST_IN_2D_AND_3D(CageTest, TooFewControlPointsOrFacets) {
  Cage<Dim> cage;
  EXPECT_TRUE(reports(find_defects(cage), {"0 control points", std::to_string(Dim + 1)}));
  cage = box_cage<Dim>(1);
  cage.facets.conservativeResize(Dim, Dim);
  EXPECT_TRUE(
      reports(find_defects(cage), {std::to_string(Dim) + (Dim == 2 ? " edges" : " triangles")}));
}

TEST_IN_2D_AND_3D(CageTest, NumbersThatAreNotFinite) {
  for (double bad : {std::nan(""), std::numeric_limits<double>::infinity()}) {
    Cage<Dim> cage = box_cage<Dim>(1);
    cage.points(1, 2) = bad;
    EXPECT_TRUE(reports(find_defects(cage), {"control point 2", "not finite"}, {2}));
    EXPECT_THROW(validate(cage), InputError);
  }
}

TEST_IN_2D_AND_3D(CageTest, IndicesOutOfRange) {
  for (Index bad : {-1, 1 << Dim}) {
    Cage<Dim> cage = box_cage<Dim>(1);
    cage.facets(1, 3) = bad;
    const std::vector<Defect> defects = find_defects(cage);
    EXPECT_TRUE(reports(defects, {Dim == 2 ? "edge 3" : "triangle 3", std::to_string(bad)}));
    EXPECT_EQ(defects.front().facets, std::vector<Index>{3});
  }
}

TEST_IN_2D_AND_3D(CageTest, FacetThatNamesAControlPointTwice) {
  Cage<Dim> cage = box_cage<Dim>(1);
  cage.facets(Dim - 1, 2) = cage.facets(0, 2);
  EXPECT_TRUE(reports(find_defects(cage), {"twice", Dim == 2 ? "edge 2" : "triangle 2"}));
}

TEST_IN_2D_AND_3D(CageTest, CoincidingControlPointsAreCalledUnwelded) {
  const Cage<Dim> box = box_cage<Dim>(1);
  for (double gap : {0.0, 1e-11}) {
    Cage<Dim> cage = box;
    cage.points.conservativeResize(Dim, box.size() + 1);
    cage.points.col(box.size()) = box.points.col(1) + Vector<Dim>::Constant(gap);
    cage.facets(0, 1) = box.size();  // a facet at corner 1 (2D) or corner 0 (3D) comes loose
    EXPECT_TRUE(reports(find_defects(cage), {"coincide", "not welded", "(1, -1"}, {1, box.size()}));
  }
  Cage<Dim> close = box;
  close.points(0, 0) = close.points(0, 1) - 1e-8;  // thin, but distinct
  EXPECT_TRUE(find_defects(close).empty());
}

TEST_IN_2D_AND_3D(CageTest, UnreferencedControlPoint) {
  Cage<Dim> cage = box_cage<Dim>(1);
  cage.points.conservativeResize(Dim, cage.size() + 1);
  cage.points.col(cage.size() - 1).setConstant(0.125);
  const Index last = cage.size() - 1;
  EXPECT_TRUE(reports(find_defects(cage),
                      {"control point " + std::to_string(last), "belongs to no", "(0.125, 0.125"},
                      {last}));
}

TEST_IN_2D_AND_3D(CageTest, FlatCage) {
  // Sheared, so that the flat direction is no axis.
  Cage<Dim> cage = box_cage<Dim>(1);
  cage.points.row(Dim - 1) = cage.points.row(0) * 0.7;
  for (int corner = 0; corner < cage.size(); ++corner) {
    cage.points.col(corner) +=
        0.1 * corner * (Vector<Dim>::Unit(0) + 0.7 * Vector<Dim>::Unit(Dim - 1));
  }
  EXPECT_TRUE(
      reports(find_defects(cage), {"all control points are in one", Dim == 2 ? "line" : "plane"}));
}

TEST_IN_2D_AND_3D(CageTest, FacetThatOccursTwice) {
  Cage<Dim> cage = box_cage<Dim>(1);
  const Index first = 1, last = static_cast<Index>(cage.facets.cols());
  cage.facets.conservativeResize(Dim, last + 1);
  cage.facets.col(last) = cage.facets.col(first).reverse();
  EXPECT_TRUE(reports(find_defects(cage), {"1 and " + std::to_string(last) + " are the same"}));
}

TEST_IN_2D_AND_3D(CageTest, OpenCage) {
  const Cage<Dim> box = box_cage<Dim>(1);
  const std::vector<Defect> defects = find_defects(without_facet(box, 0));
  const std::size_t rims = Dim;  // a missing facet has Dim vertices (2D) or edges (3D)
  EXPECT_EQ(defects.size(), rims);
  for (int k = 0; k < Dim; ++k) {
    const Index a = box.facets(k, 0), b = box.facets((k + 1) % Dim, 0);
    if (Dim == 2) {
      EXPECT_TRUE(reports(defects, {"open at control point " + std::to_string(a)}, {a}));
    } else {
      EXPECT_TRUE(reports(defects, {"open at the edge between"}, {a, b}));
    }
  }
  EXPECT_THROW(validate(without_facet(box, 0)), InputError);
}

TEST_IN_2D_AND_3D(CageTest, LimitCutsTheListAndTheMostFundamentalComesFirst) {
  Cage<Dim> cage = join(box_cage<Dim>(1), box_cage<Dim>(1));  // every control point twice
  EXPECT_EQ(find_defects(cage, 3).size(), 3u);
  cage.points(0, 0) = std::nan("");
  EXPECT_TRUE(reports(find_defects(cage, 1), {"not finite"}));
}

TEST(Cage2Test, DirectionsOfEdgesAreFree) {
  Cage<2> cage = box_cage<2>(1);
  cage.facets.col(1).reverseInPlace();
  EXPECT_TRUE(find_defects(cage).empty());
}

TEST(Cage2Test, CollinearControlPointsAreAllowed) {
  EXPECT_TRUE(find_defects(loop(PointList<2>{{0, 1, 2, 2, 0}, {0, 0, 0, 1, 1}})).empty());
}

TEST(Cage2Test, Branch) {
  Cage<2> cage = box_cage<2>(1);
  cage.facets.conservativeResize(2, 5);
  cage.facets.col(4) << 0, 3;  // a diagonal
  const std::vector<Defect> defects = find_defects(cage);
  EXPECT_TRUE(reports(defects, {"branches at control point 0", "(-1, -1)"}, {0}));
  EXPECT_TRUE(reports(defects, {"branches at control point 3", "(1, 1)"}, {3}));
}

TEST(Cage3Test, InconsistentOrientationNamesEdgeAndTriangles) {
  Cage<3> cage = box_cage<3>(1);
  cage.facets.col(5).reverseInPlace();
  const std::vector<Defect> defects = find_defects(cage);
  EXPECT_EQ(defects.size(), 3u);  // the edges of triangle 5
  for (const Defect& defect : defects) {
    EXPECT_TRUE(reports({defect}, {"oriented inconsistently"}));
    EXPECT_EQ(std::count(defect.facets.begin(), defect.facets.end(), 5), 1);
  }
}

TEST(Cage3Test, DegenerateTriangle) {
  Cage<3> cage = box_cage<3>(1);
  // Corner 2 moves onto the line through 0 and 3; triangle 0 is (0, 2, 3).
  cage.points.col(2) = (cage.points.col(0) + cage.points.col(3)) / 2;
  EXPECT_TRUE(reports(find_defects(cage), {"triangle 0 is degenerate", "on one line"}, {0, 2, 3}));
}

TEST(Cage3Test, NonManifoldEdge) {
  // Two tetrahedra with a common edge 0-1.
  Cage<3> cage{
      PointList<3>{{0, 0, 1, 1, -1, -1}, {0, 0, 0, 1, 0, -1}, {0, 1, 0, 0, 0, 0}},
      FacetList<3>{{0, 0, 0, 1, 0, 0, 0, 1}, {1, 2, 3, 3, 1, 4, 5, 5}, {2, 3, 1, 2, 4, 5, 1, 4}}};
  EXPECT_TRUE(reports(find_defects(cage), {"non-manifold", "triangles 0, 2, 4 and 6"}, {0, 1}));
}

TEST(Cage3Test, NonManifoldVertex) {
  // Two boxes that touch in one corner, which they share.
  Cage<3> cage = join(box_cage<3>(0, 1), box_cage<3>(1, 2));
  for (Index& vertex : cage.facets.reshaped()) {
    if (vertex == 8) vertex = 7;
    if (vertex > 8) --vertex;
  }
  PointList<3> points(3, 15);
  points << cage.points.leftCols(8), cage.points.rightCols(7);
  cage.points = points;
  const std::vector<Defect> defects = find_defects(cage);
  EXPECT_EQ(defects.size(), 1u);
  EXPECT_TRUE(reports(defects, {"non-manifold at control point 7", "2 separate fans"}, {7}));
}

TEST(RealCageTest, DefectiveOnes) {
  if (!has_model("defective/unwelded_cage.obj")) GTEST_SKIP() << "the real models are absent";
  const auto defects = [](const char* name) {
    return find_defects(load_cage<3>("defective/" + std::string(name)), 1000);
  };
  EXPECT_TRUE(reports({defects("unwelded_cage.obj").front()}, {"coincide", "not welded"}));
  EXPECT_TRUE(reports(defects("non_manifold_cage.obj"), {"is non-manifold: triangles"}));
  EXPECT_TRUE(
      reports({defects("inconsistent_orientation_cage.obj").front()}, {"oriented inconsistently"}));
  // These need constructions or a model to be found out.
  EXPECT_TRUE(defects("self_intersecting_cage.obj").empty());
  EXPECT_TRUE(defects("genus1_self_intersecting_cage.obj").empty());
  EXPECT_TRUE(defects("half_outside_cage.obj").empty());
}

}  // namespace
}  // namespace flbc::testing
