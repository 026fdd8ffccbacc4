// SPDX-License-Identifier: BSD-3-Clause
#include "meshing/surface_subdivision.h"

#include "support/mesh_checks.h"

namespace flbc::testing {
namespace {

constexpr std::size_t kMany = 1'000'000;

double longest_edge(const Cage<3>& cage) {
  double longest = 0;
  for (Index t = 0; t < cage.facets.cols(); ++t) {
    for (int k = 0; k < 3; ++k) {
      const auto a = cage.points.col(cage.facets(k, t));
      const auto b = cage.points.col(cage.facets((k + 1) % 3, t));
      longest = std::max(longest, (a - b).norm());
    }
  }
  return longest;
}

TEST(SurfaceSubdivisionTest, TheSurfaceStaysTheSameClosedSurface) {
  const Cage<3> cages[] = {box_cage<3>(1), join(box_cage<3>(1), box_cage<3>(0.9)),
                           box_cage<3>(Vector<3>(0, 0, 0), Vector<3>(1, 3, 1e-3))};
  for (const Cage<3>& cage : cages) {
    for (const double longest : {10.0, 0.5, 0.11}) {
      const Cage<3> finer = subdivide_surface(cage, longest, kMany);
      EXPECT_LE(longest_edge(finer), std::min(longest, longest_edge(cage)));
      EXPECT_EQ(PointList<3>(finer.points.leftCols(cage.size())), cage.points);
      EXPECT_TRUE(find_defects(finer).empty());
      const double area = sum_of_facets<3>(cage.points, cage.facets);
      EXPECT_NEAR(sum_of_facets<3>(finer.points, finer.facets), area, 1e-12 * area);
      EXPECT_NEAR(enclosed_measure(finer), enclosed_measure(cage), 1e-9);
      for (Index t = 0; t < finer.facets.cols(); ++t) {
        const Eigen::Matrix<Index, 3, 1> corners = finer.facets.col(t);
        ASSERT_TRUE(lies_in_one_facet<3>(cage, finer.points, corners, 1e-12));
      }
    }
  }
}

TEST(SurfaceSubdivisionTest, ShortEdgesAreLeftAlone) {
  const Cage<3> cage = box_cage<3>(1);
  const Cage<3> same = subdivide_surface(cage, 10, kMany);
  EXPECT_EQ(same.points, cage.points);
  EXPECT_EQ(same.facets, cage.facets);
}

// Its two long edges take turns, and each division divides a neighbor, which divides the next one.
TEST(SurfaceSubdivisionTest, NeedlesThatWouldTakeMillionsOfPointsAreRefused) {
  const Cage<3> cage = box_cage<3>(Vector<3>(0, 0, 0), Vector<3>(1e6, 1, 1));
  EXPECT_THROW(subdivide_surface(cage, 1000, 100'000), InputError);
  const Cage<3> finer = subdivide_surface(cage, 1e5, 100'000);
  EXPECT_LE(finer.size(), 100'000);
}

}  // namespace
}  // namespace flbc::testing
