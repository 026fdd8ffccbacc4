// SPDX-License-Identifier: BSD-3-Clause
// Sizes and parts of cages known beforehand.
#include "flbc/cage_facts.h"

#include "support/feasible_vertices.h"

namespace flbc::testing {
namespace {

TEST_IN_2D_AND_3D(CageFactsTest, ABoxIsAsThinAsItsNarrowSides) {
  for (const double thickness : {1.0, 0.25, 1e-5}) {
    Vector<Dim> high = Vector<Dim>::Constant(1);
    high[Dim - 1] = thickness;
    const auto cage = box_cage<Dim>(Vector<Dim>::Zero(), high);
    const auto place = thinnest_place(cage);
    // In 3D the corners of the narrow sides are nearest to these sides' diagonals.
    const double expected = Dim == 2 ? thickness : thickness / std::hypot(1, thickness);
    EXPECT_NEAR(place.distance, expected, 1e-15);
    EXPECT_FALSE((cage.facets.col(place.facet).array() == place.control_point).any());
  }
}

// Its opposite edges pass each other, while each corner is far from the opposite facet.
TEST(CageFactsTest, AFlatTetrahedronIsAsThinAsItsEdgesAreClose) {
  for (const double height : {1e-2, 1e-5, 1e-8}) {
    Cage<3> cage{PointList<3>(3, 4), FacetList<3>(3, 4)};
    cage.points << 0, 2, 2, 0,  //
        0, 0, 2, 2,             //
        0, height, 0, height;
    cage.facets << 0, 0, 0, 1,  //
        2, 1, 3, 2,             //
        1, 3, 2, 3;
    const auto place = thinnest_place(cage);
    EXPECT_NEAR(place.distance, height, 1e-15);  // of the diagonals of the square
    EXPECT_FALSE((cage.facets.col(place.facet).array() == place.control_point).any());
  }
}

TEST_IN_2D_AND_3D(CageFactsTest, ACavityNearTheSurfaceIsAThinWall) {
  const auto cage = join(box_cage<Dim>(1), box_cage<Dim>(0.99));
  // Corners of the cavity are nearest to the outside.
  const auto place = thinnest_place(cage);
  EXPECT_NEAR(place.distance, 0.01, 1e-15);
  EXPECT_GE(place.control_point, cage.size() / 2);
}

// Every control point and every facet, by points spread over the facet.
TEST_IN_2D_AND_3D(CageFactsTest, NoPlaceIsThinner) {
  Numbers numbers(5);
  for (int k = 0; k < 20; ++k) {
    auto cage = join(box_cage<Dim>(1), box_cage<Dim>(0.5 + 0.02 * k));
    for (auto point : cage.points.colwise())
      point += Vector<Dim>(numbers.matrix(Dim, 1, -0.1, 0.1));
    const auto place = thinnest_place(cage);
    for (Index f = 0; f < cage.facets.cols(); ++f) {
      for (Index i = 0; i < cage.size(); ++i) {
        if ((cage.facets.col(f).array() == i).any()) continue;
        const PointList<Dim> corners = cage.points(Eigen::all, cage.facets.col(f));
        for (int n = 0; n < 50; ++n) {
          const Vector<Dim> on_facet = corners * numbers.convex(Dim);
          EXPECT_GE((on_facet - cage.points.col(i)).norm(), place.distance - 1e-15);
        }
      }
    }
  }
}

// Numbers from first on, as many as a box has corners.
template <int Dim>
std::vector<Index> corners_from(Index first) {
  std::vector<Index> numbers(1 << Dim);
  std::iota(numbers.begin(), numbers.end(), first);
  return numbers;
}

TEST_IN_2D_AND_3D(CagePartsTest, NestsAndNeighbours) {
  constexpr Index n = 1 << Dim;
  // A nest of five boxes around the origin, of which two are holes, given from the middle outward
  // and inward; and two boxes next to it, one with a hole.
  Cage<Dim> cage = join(box_cage<Dim>(0.5), reversed(box_cage<Dim>(0.7)));  // a hole around a part
  cage = join(cage, box_cage<Dim>(1));
  cage = join(cage, box_cage<Dim>(0.3));  // a hole in the innermost but one
  cage = join(cage, reversed(box_cage<Dim>(0.1)));
  cage = join(cage, box_cage<Dim>(5, 6));
  cage = join(join(cage, box_cage<Dim>(2, 3)), box_cage<Dim>(2.2, 2.8));
  const auto parts = cage_parts(cage);
  ASSERT_EQ(parts.size(), 5u);
  EXPECT_EQ(measure_cage(cage).parts, 5);

  const auto expect_part = [&](std::size_t p, std::vector<Index> boxes, double measure) {
    std::vector<Index> numbers;
    for (const Index box : boxes) {
      const auto corners = corners_from<Dim>(box * n);
      numbers.insert(numbers.end(), corners.begin(), corners.end());
    }
    EXPECT_EQ(parts[p].control_points, numbers) << p;
    EXPECT_TRUE(find_defects(parts[p].cage).empty()) << p;
    EXPECT_EQ(parts[p].cage.points, PointList<Dim>(cage.points(Eigen::all, numbers))) << p;
    const auto facts = measure_cage(parts[p].cage);
    EXPECT_EQ(facts.parts, 1) << p;
    EXPECT_EQ(facts.holes, Index(boxes.size()) - 1) << p;
    EXPECT_NEAR(facts.measure, measure, 1e-12) << p;
  };
  const auto volume = [](double side) { return std::pow(side, Dim); };
  expect_part(0, {0, 3}, volume(1) - volume(0.6));
  expect_part(1, {1, 2}, volume(2) - volume(1.4));
  expect_part(2, {4}, volume(0.2));
  expect_part(3, {5}, volume(1));
  expect_part(4, {6, 7}, volume(1) - volume(0.6));
}

TEST_IN_2D_AND_3D(CagePartsTest, OnePartIsTheWhole) {
  const auto cage = join(box_cage<Dim>(1), box_cage<Dim>(0.5));
  const auto parts = cage_parts(cage);
  ASSERT_EQ(parts.size(), 1u);
  EXPECT_EQ(parts[0].cage.points, cage.points);
  EXPECT_EQ(parts[0].cage.facets, cage.facets);
}

}  // namespace
}  // namespace flbc::testing
