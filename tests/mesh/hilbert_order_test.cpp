// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/hilbert_order.h"

#include "support/test.h"

namespace flbc {
namespace {

// The properties that define a Hilbert curve: it visits all cells of the grid, each once, steps
// from each to one of its neighbors, and refines the curve of the coarser grid.
TEST_IN_2D_AND_3D(SpatialOrderTest, CurveVisitsAllCellsInUnitSteps) {
  for (int levels : {1, 2, 3, 4}) {
    const std::uint32_t side = 1u << levels;
    const std::size_t count = std::size_t{1} << (levels * Dim);
    std::vector<std::array<std::uint32_t, 3>> visited(count, {side, side, side});
    std::uint32_t cell[3];
    for (cell[0] = 0; cell[0] < side; ++cell[0]) {
      for (cell[1] = 0; cell[1] < side; ++cell[1]) {
        for (cell[2] = 0; cell[2] < (Dim == 3 ? side : 1); ++cell[2]) {
          std::uint32_t place[Dim];
          std::copy(cell, cell + Dim, place);
          const std::uint64_t index = hilbert_index<Dim>(place, levels);
          ASSERT_LT(index, count);
          std::uint32_t parent[Dim];
          for (int axis = 0; axis < Dim; ++axis) parent[axis] = cell[axis] / 2;
          EXPECT_EQ(index >> Dim, hilbert_index<Dim>(parent, levels - 1));
          EXPECT_EQ(visited[index][0], side) << "visited twice";
          visited[index] = {cell[0], cell[1], cell[2]};
        }
      }
    }
    for (std::size_t i = 1; i < count; ++i) {
      int steps = 0;
      for (int axis = 0; axis < Dim; ++axis) {
        steps += std::abs(int(visited[i][axis]) - int(visited[i - 1][axis]));
      }
      EXPECT_EQ(steps, 1) << "at " << i << " of level " << levels;
    }
  }
}

TEST_IN_2D_AND_3D(SpatialOrderTest, OrderIsAPermutationWithShortSteps) {
  std::srand(1);
  const PointList<Dim> points = PointList<Dim>::Random(Dim, 4000);
  const std::vector<Index> order = spatial_order<Dim>(points);
  EXPECT_EQ(std::set<Index>(order.begin(), order.end()).size(), 4000u);
  double along_curve = 0, along_input = 0;
  for (Index i = 1; i < 4000; ++i) {
    along_curve += (points.col(order[i]) - points.col(order[i - 1])).norm();
    along_input += (points.col(i) - points.col(i - 1)).norm();
  }
  EXPECT_LT(along_curve, 0.15 * along_input);
}

TEST_IN_2D_AND_3D(SpatialOrderTest, NoPointsOnePointAndCoincidingPoints) {
  EXPECT_TRUE(spatial_order<Dim>(PointList<Dim>(Dim, 0)).empty());
  EXPECT_EQ(spatial_order<Dim>(PointList<Dim>::Constant(Dim, 1, 3.0)), std::vector<Index>{0});
  EXPECT_EQ(spatial_order<Dim>(PointList<Dim>::Constant(Dim, 3, 3.0)),
            (std::vector<Index>{0, 1, 2}));
}

TEST_IN_2D_AND_3D(SpatialOrderTest, ReorderingKeepsFixedVerticesAndTheMesh) {
  // A fan of cells around the origin, which is the last point.
  const Cage<Dim> cage = flbc::testing::box_cage<Dim>(1);
  DomainMesh<Dim> mesh;
  mesh.points.resize(Dim, cage.size() + 1);
  mesh.points << cage.points, Vector<Dim>::Zero();
  mesh.cells.resize(Dim + 1, cage.facets.cols());
  mesh.cells.topRows(Dim) = cage.facets;
  mesh.cells.row(Dim).setConstant(cage.size());

  // Cells as sets of coordinates do not depend on numbering.
  const auto cells_of = [](const DomainMesh<Dim>& m) {
    std::multiset<std::vector<double>> cells;
    for (Index cell = 0; cell < m.num_cells(); ++cell) {
      std::vector<double> corners;
      for (int k = 0; k <= Dim; ++k) {
        for (int axis = 0; axis < Dim; ++axis) corners.push_back(m.points(axis, m.cells(k, cell)));
      }
      cells.insert(corners);
    }
    return cells;
  };
  DomainMesh<Dim> ordered = mesh;
  const Index num_fixed = 3;
  reorder_in_space(ordered, num_fixed);
  EXPECT_EQ(ordered.points.leftCols(num_fixed), mesh.points.leftCols(num_fixed));
  EXPECT_NE(ordered.points, mesh.points);
  EXPECT_EQ(cells_of(ordered), cells_of(mesh));
}

}  // namespace
}  // namespace flbc
