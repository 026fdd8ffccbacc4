// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/meshing.h"

#include "support/test.h"

namespace flbc::testing {
namespace {

TEST_IN_2D_AND_3D(EmbeddablePointsTest, InsideAndEachOnce) {
  for (const double size : {1e-3, 1.0, 1e5}) {
    const Cage<Dim> cage = box_cage<Dim>(size);
    PointList<Dim> points(Dim, 9);
    for (int p = 0; p < 9; ++p) points.col(p).setConstant(0.1 * p);
    points.col(2) = points.col(1);                  // the same
    points(0, 5) = 1;                               // on the cage
    points(0, 6) = 1 + 1e-7;                        // outside
    points.col(7) = Vector<Dim>::Ones();            // a control point
    points.col(8) = points.col(0).array() + 1e-10;  // as good as the same
    points *= size;
    const auto found = embeddable_points<Dim>(cage, points);
    EXPECT_EQ(found.number, (std::vector<Index>{0, 1, 1, 2, 3, -1, -1, -1, 0}));
    ASSERT_EQ(found.points.cols(), 4);
    EXPECT_EQ(found.points.col(1), points.col(1));
    EXPECT_EQ(found.points.col(3), points.col(4));
  }
}

}  // namespace
}  // namespace flbc::testing
