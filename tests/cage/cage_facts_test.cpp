// SPDX-License-Identifier: BSD-3-Clause
// Sizes of cages known beforehand.
#include "flbc/cage_facts.h"

#include <cmath>
#include <type_traits>

#include <gtest/gtest.h>

#include "support/code_cages.h"

namespace flbc::testing {
namespace {

template <class Dimension>
class CageFactsTest : public ::testing::Test {};
using Dimensions = ::testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(CageFactsTest, Dimensions);

TYPED_TEST(CageFactsTest, ABoxIsAsThinAsItsNarrowSides) {
  constexpr int kDim = TypeParam::value;
  for (const double thickness : {1.0, 0.25, 1e-5}) {
    Vector<kDim> high = Vector<kDim>::Constant(1);
    high[kDim - 1] = thickness;
    const auto cage = box_cage<kDim>(Vector<kDim>::Zero(), high);
    const auto place = thinnest_place(cage);
    // In 3D the corners of the narrow sides are nearest to these sides' diagonals.
    const double expected = kDim == 2 ? thickness : thickness / std::hypot(1, thickness);
    EXPECT_NEAR(place.distance, expected, 1e-15);
    EXPECT_FALSE((cage.facets.col(place.facet).array() == place.control_point).any());
  }
}

TYPED_TEST(CageFactsTest, ACavityNearTheSurfaceIsAThinWall) {
  constexpr int kDim = TypeParam::value;
  const auto cage = join(box_cage<kDim>(1), box_cage<kDim>(0.99));
  // Corners of the cavity are nearest to the outside.
  const auto place = thinnest_place(cage);
  EXPECT_NEAR(place.distance, 0.01, 1e-15);
  EXPECT_GE(place.control_point, cage.size() / 2);
}

}  // namespace
}  // namespace flbc::testing
