// SPDX-License-Identifier: BSD-3-Clause
#include "meshing/tetgen/flat_parts.h"

#include "support/mesh_checks.h"

namespace flbc::testing {
namespace {

// A pyramid over the unit square 0 1 2 3 with apex 4; the cage's base is split along 0-2.
Cage<3> pyramid() {
  Cage<3> cage{PointList<3>{{0, 1, 1, 0, 0.3}, {0, 0, 1, 1, 0.4}, {0, 0, 0, 0, 1}},
               FacetList<3>{{0, 0, 0, 1, 2, 3}, {2, 3, 1, 2, 3, 0}, {1, 2, 4, 4, 4, 4}}};
  return cage;
}

TEST(FlatPartsTest, CoplanarFacetsAreFound) {
  EXPECT_TRUE(has_coplanar_facets(pyramid()));
  EXPECT_TRUE(has_coplanar_facets(flbc::testing::box_cage<3>(1)));
  Cage<3> bent = pyramid();
  bent.points(2, 3) = -1e-6;
  EXPECT_FALSE(has_coplanar_facets(bent));
}

TEST(FlatPartsTest, SoundMeshesStayAsTheyAre) {
  DomainMesh<3> mesh;
  mesh.points = pyramid().points;
  mesh.cells.resize(4, 2);
  mesh.cells << 0, 0, 1, 2, 2, 3, 4, 4;
  const DomainMesh<3> before = mesh;
  peel_flat_cells(pyramid(), 5, mesh);
  EXPECT_EQ(mesh.points, before.points);
  EXPECT_EQ(mesh.cells, before.cells);
}

// The cells below the base meet in the other diagonal, 1-3; a flat one fills the gap.
TEST(FlatPartsTest, FlatCellBetweenCrossingDiagonals) {
  const Cage<3> cage = pyramid();
  DomainMesh<3> mesh;
  mesh.points = cage.points;
  mesh.cells.resize(4, 3);
  mesh.cells << 0, 1, 0,  //
      1, 2, 1,            //
      3, 3, 2,            //
      4, 4, 3;
  peel_flat_cells(cage, 5, mesh);
  normalize_and_validate(mesh);
  expect_fills(cage, mesh, 1.0 / 3);
  EXPECT_TRUE(covers_edges(cage, mesh));
  ASSERT_EQ(mesh.num_vertices(), 6);  // the crossing is new
  EXPECT_LT((mesh.points.col(5) - Vector<3>(0.5, 0.5, 0)).norm(), 1e-15);
}

// A control point in the middle of a flat side that belongs to a flat cell only.
TEST(FlatPartsTest, ControlPointIsPutBack) {
  Cage<3> cage{PointList<3>{{0, 1, 0, 0.2, 0.25}, {0, 0, 1, 0.3, 0.25}, {0, 0, 0, 1, 0}},
               FacetList<3>{{1, 2, 0, 0, 1, 2}, {0, 1, 2, 1, 2, 0}, {4, 4, 4, 3, 3, 3}}};
  DomainMesh<3> mesh;
  mesh.points = cage.points;
  mesh.cells.resize(4, 2);
  mesh.cells << 0, 0, 1, 1, 2, 2, 3, 4;
  peel_flat_cells(cage, 5, mesh);
  normalize_and_validate(mesh);
  EXPECT_EQ(mesh.num_cells(), 3);
  expect_fills(cage, mesh, 1.0 / 6);
  EXPECT_TRUE(covers_edges(cage, mesh));
}

TEST(FlatPartsTest, FlatCellInsideIsRefused) {
  // Two tetrahedra on either side of a flat cell 0 1 2 3 in the plane z = 0, as in a bipyramid.
  Cage<3> cage{
      PointList<3>{{0, 1, 1, 0, 0.5, 0.5}, {0, 0, 1, 1, 0.5, 0.5}, {0, 0, 0, 0, 1, -1}},
      FacetList<3>{{0, 1, 2, 3, 1, 2, 3, 0}, {1, 2, 3, 0, 0, 1, 2, 3}, {4, 4, 4, 4, 5, 5, 5, 5}}};
  DomainMesh<3> mesh;
  mesh.points = cage.points;
  mesh.cells.resize(4, 5);
  mesh.cells << 0, 0, 0, 1, 0,  //
      1, 2, 1, 2, 1,            //
      2, 3, 3, 3, 2,            //
      4, 4, 5, 5, 3;
  EXPECT_THROW(peel_flat_cells(cage, 6, mesh), InputError);
}

}  // namespace
}  // namespace flbc::testing
