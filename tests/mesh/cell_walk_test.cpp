// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/cell_walk.h"

#include "mesh/cell_geometry.h"
#include "support/test.h"

namespace flbc::testing {
namespace {

template <int Dim>
PointList<Dim> shuffled(const PointList<Dim>& points) {
  std::vector<Index> order(points.cols());
  std::iota(order.begin(), order.end(), 0);
  std::shuffle(order.begin(), order.end(), std::mt19937(3));
  PointList<Dim> result(Dim, points.cols());
  for (Index p = 0; p < static_cast<Index>(points.cols()); ++p) {
    result.col(p) = points.col(order[p]);
  }
  return result;
}

// Vertices of a finer mesh, on the boundary too, and centroids of its cells.
template <int Dim>
PointList<Dim> points_in(Shape shape) {
  const auto mesh = make_sample<Dim>(shape, 6, 0.2).mesh;
  PointList<Dim> points(Dim, mesh.num_vertices() + mesh.num_cells());
  points << mesh.points, centroids(mesh.points, mesh.cells);
  return points;
}

// The ring has a hole, and the corner is not convex: straight ways leave them.
TEST_IN_2D_AND_3D(CellWalkTest, FindsTheCellsWhateverTheOrderOfThePoints) {
  for (const auto shape : {Shape::kBox, Shape::kCorner, Shape::kRing}) {
    const auto mesh = make_sample<Dim>(shape, 4, 0.2).mesh;
    const auto topology = build_topology(mesh);
    const auto in_order = points_in<Dim>(shape);
    for (const auto& points : {in_order, shuffled<Dim>(in_order)}) {
      const auto places = walk_to_points(mesh, topology, points);
      ASSERT_EQ(places.size(), static_cast<std::size_t>(points.cols()));
      for (std::size_t p = 0; p < places.size(); ++p) {
        EXPECT_GE(places[p].coordinates.minCoeff(), 0);
        EXPECT_NEAR(places[p].coordinates.sum(), 1, 1e-14);
        Vector<Dim> point = Vector<Dim>::Zero();
        for (int k = 0; k <= Dim; ++k) {
          point += places[p].coordinates[k] * mesh.points.col(mesh.cells(k, places[p].cell));
        }
        EXPECT_LT((point - points.col(static_cast<Index>(p))).norm(), 1e-9);
      }
    }
  }
}

TEST_IN_2D_AND_3D(CellWalkTest, IsTheSameForAnyNumberOfThreads) {
  const auto mesh = make_sample<Dim>(Shape::kRing, 3, 0.2).mesh;
  const auto topology = build_topology(mesh);
  const auto points = points_in<Dim>(Shape::kRing).replicate(1, 5).eval();
  const auto walk = [&](int count) {
    const ThreadScope threads(count);
    return walk_to_points<Dim>(mesh, topology, points);
  };
  const auto one = walk(1);
  for (const int count : {2, 4, 7}) {
    const auto more = walk(count);
    for (std::size_t p = 0; p < one.size(); ++p) {
      EXPECT_EQ(more[p].cell, one[p].cell);
      EXPECT_TRUE(more[p].coordinates == one[p].coordinates);
    }
  }
}

TEST_IN_2D_AND_3D(CellWalkTest, RefusesPointsOutside) {
  const auto mesh = make_sample<Dim>(Shape::kCorner, 3, 0.2).mesh;
  auto points = points_in<Dim>(Shape::kCorner);
  points.col(11) *= 50;
  EXPECT_THROW(walk_to_points<Dim>(mesh, build_topology(mesh), points), InputError);
}

}  // namespace
}  // namespace flbc::testing
