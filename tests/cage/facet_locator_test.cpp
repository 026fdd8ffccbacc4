// SPDX-License-Identifier: BSD-3-Clause
#include "cage/facet_locator.h"

#include "support/test.h"

namespace flbc {
namespace {

// A box with one more corner next to the last: in 3D two facets are needles of that width.
Cage<2> box_with_short_edge(double width) {
  return testing::loop(PointList<2>{{0, 1, 1, 1 - width, 0}, {0, 0, 1, 1, 1}});
}

Cage<3> box_with_needles(double width) {
  auto cage = flbc::testing::box_cage<3>(0, 1);
  cage.points.conservativeResize(3, 9);
  cage.points.col(8) << 1, 1 - width, 1;
  cage.facets.resize(3, 14);
  cage.facets << 0, 0, 4, 4, 4, 0, 0, 2, 2, 0, 0, 1, 1, 1,  //
      2, 3, 8, 5, 7, 1, 5, 6, 7, 4, 6, 3, 7, 8,             //
      3, 1, 7, 8, 6, 5, 4, 7, 3, 6, 2, 7, 8, 5;
  return cage;
}

template <int Dim>
Cage<Dim> narrow_cage(double width) {
  if constexpr (Dim == 2) {
    return box_with_short_edge(width);
  } else {
    return box_with_needles(width);
  }
}

// Points made of known coordinates in a facet are found on the cage, up to rounding.
TEST_IN_2D_AND_3D(FacetLocatorTest, PointsOnNeedlesAreWhereTheyAre) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> part(0, 1);
  for (const double width : {1e-2, 1e-4, 1e-6, 1e-8}) {
    const auto cage = narrow_cage<Dim>(width);
    ASSERT_TRUE(find_defects(cage).empty());
    const FacetLocator<Dim> locator(cage, 1e-6);
    for (Index f = 0; f < cage.facets.cols(); ++f) {
      for (int k = 0; k < 50; ++k) {
        Vector<Dim> coordinates;
        for (int d = 0; d < Dim; ++d) coordinates[d] = -std::log(part(random));
        coordinates /= coordinates.sum();
        Vector<Dim> point = Vector<Dim>::Zero();
        for (int d = 0; d < Dim; ++d) point += coordinates[d] * cage.points.col(cage.facets(d, f));
        const auto found = locator.nearest(point);
        EXPECT_LT(found.distance, 1e-14) << "facet " << f << " of width " << width;
        ASSERT_GE(found.facet, 0);
        Vector<Dim> place = Vector<Dim>::Zero();
        for (int d = 0; d < Dim; ++d) {
          place += found.coordinates[d] * cage.points.col(cage.facets(d, found.facet));
        }
        EXPECT_LT((place - point).norm(), 1e-14);
        EXPECT_GE(found.coordinates.minCoeff(), 0);
      }
    }
  }
}

}  // namespace
}  // namespace flbc
