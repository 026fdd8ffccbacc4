// SPDX-License-Identifier: BSD-3-Clause
// Sizes of cages known beforehand.
#include "flbc/cage_facts.h"

#include "support/feasible_vertices.h"
#include "support/test.h"

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

}  // namespace
}  // namespace flbc::testing
