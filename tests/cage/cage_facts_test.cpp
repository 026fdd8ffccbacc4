// SPDX-License-Identifier: BSD-3-Clause
// Sizes of cages known beforehand.
#include "flbc/cage_facts.h"

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

}  // namespace
}  // namespace flbc::testing
