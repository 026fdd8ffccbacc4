// SPDX-License-Identifier: BSD-3-Clause
#include "cage/point_in_cage.h"

#include "support/test.h"

namespace flbc::testing {
namespace {

// The true answer for a nest of boxes around the origin with the given half sides.
template <int Dim>
Containment expected(const Vector<Dim>& point, const std::vector<double>& halves) {
  const double radius = point.template lpNorm<Eigen::Infinity>();
  int enclosing = 0;
  for (double half : halves) enclosing += radius < half;
  return enclosing % 2 == 1 ? Containment::kInside : Containment::kOutside;
}

TEST_IN_2D_AND_3D(InsideTest, NestsOfBoxesWhateverTheirOrientation) {
  const std::vector<double> halves{1, 0.6, 0.3};
  const Cage<Dim> outer = box_cage<Dim>(1), middle = box_cage<Dim>(0.6), core = box_cage<Dim>(0.3);
  Cage<Dim> mixed = join(join(reversed(outer), middle), reversed(core));
  if (Dim == 2) mixed.facets.col(1).reverseInPlace();  // in 2D even edge by edge
  for (const Cage<Dim>& cage : {join(join(outer, middle), core), mixed}) {
    const CageLocator<Dim> locator(cage, 1e-9);
    int checked = 0;
    for (double x = -1.25; x <= 1.25; x += 0.25) {  // rays meet corners and run along sides
      for (double y = -1.25; y <= 1.25; y += 0.125) {
        Vector<Dim> point = Vector<Dim>::Constant(0.25);
        point(0) = x;
        point(1) = y;
        const double radius = point.template lpNorm<Eigen::Infinity>();
        if (radius == 1) continue;
        EXPECT_EQ(locator.locate(point), expected<Dim>(point, halves)) << point.transpose();
        ++checked;
      }
    }
    EXPECT_GT(checked, 100);
  }
}

TEST_IN_2D_AND_3D(InsideTest, PointsOnTheCage) {
  const Cage<Dim> cage = box_cage<Dim>(1);
  const CageLocator<Dim> locator(cage, 1e-9);
  for (Index facet = 0; facet < cage.facets.cols(); ++facet) {
    Vector<Dim> middle = Vector<Dim>::Zero();
    for (int k = 0; k < Dim; ++k) middle += cage.points.col(cage.facets(k, facet)) / Dim;
    EXPECT_EQ(locator.locate(middle), Containment::kOnCage);
    EXPECT_EQ(locator.locate(middle * (1 + 1e-10)), Containment::kOnCage);
    EXPECT_EQ(locator.locate(middle * (1 - 1e-6)), Containment::kInside);
    EXPECT_EQ(locator.locate(middle * (1 + 1e-6)), Containment::kOutside);
  }
  for (Index corner = 0; corner < cage.size(); ++corner) {
    EXPECT_EQ(locator.locate(cage.points.col(corner)), Containment::kOnCage);
    EXPECT_EQ(locator.locate(cage.points.col(corner) * (1 - 1e-6)), Containment::kInside);
    EXPECT_EQ(locator.locate(cage.points.col(corner) * (1 + 1e-6)), Containment::kOutside);
  }
}

TEST_IN_2D_AND_3D(InsideTest, ShellsAreNumberedInTheOrderOfTheirFacets) {
  const Cage<Dim> box = box_cage<Dim>(1);
  const std::vector<Index> shells = facet_shells(join(join(box, box_cage<Dim>(0.5)), box));
  const auto count = static_cast<std::size_t>(box.facets.cols());
  ASSERT_EQ(shells.size(), 3 * count);
  for (std::size_t facet = 0; facet < shells.size(); ++facet) {
    EXPECT_EQ(shells[facet], static_cast<Index>(facet / count));
  }
}

}  // namespace
}  // namespace flbc::testing
