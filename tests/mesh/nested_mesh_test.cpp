// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/nested_mesh.h"

#include "support/mesh_checks.h"

namespace flbc::testing {
namespace {

TEST_IN_2D_AND_3D(NestedMeshTest, RefiningKeepsTheShapeAndTheSizesOfCells) {
  const auto mesh = make_sample<Dim>(Shape::kCorner, 3, 0.2).mesh;
  auto refined = refine(mesh);
  EXPECT_EQ(refined.num_vertices(), refined_vertices(mesh));
  EXPECT_EQ(refined.num_cells(), (1 << Dim) * mesh.num_cells());
  const double measure = total_volume(mesh);
  EXPECT_NEAR(total_volume(refined), measure, 1e-12 * measure);
  for (Index s = 0; s < refined.num_cells(); ++s) {
    EXPECT_NEAR(signed_measure(refined, s) * (1 << Dim), signed_measure(mesh, s >> Dim),
                1e-12 * measure);
  }
  const auto cells = refined.cells;
  normalize_and_validate(refined);  // that parts meet at common facets, too
  EXPECT_EQ(refined.cells, cells);
}

TEST_IN_2D_AND_3D(NestedMeshTest, AVertexIsBetweenTheEndsOfItsEdge) {
  const auto mesh = make_sample<Dim>(Shape::kRing, 3, 0.2).mesh;
  const auto refined = refine(mesh);
  const auto coarse = coarse_mesh(refined);
  ASSERT_TRUE(coarse);
  EXPECT_EQ(coarse->mesh.points, mesh.points);
  EXPECT_EQ(coarse->mesh.cells, mesh.cells);
  std::set<std::array<Index, 2>> edges;
  for (Index v = 0; v < refined.num_vertices(); ++v) {
    const auto [a, b] = coarse->ends[v];
    EXPECT_TRUE(edges.insert({a, b}).second);
    EXPECT_EQ(a == b, v < mesh.num_vertices());
    EXPECT_LT((refined.points.col(v) - (mesh.points.col(a) + mesh.points.col(b)) / 2).norm(),
              1e-15);
  }
}

TEST_IN_2D_AND_3D(NestedMeshTest, IsRecognizedAfterAMoveThatKeepsCells) {
  auto refined = refine(make_sample<Dim>(Shape::kBox, 3, 0.2).mesh);
  for (auto point : refined.points.colwise()) point[0] += 0.3 * point[1] * point[1];
  EXPECT_TRUE(coarse_mesh(refined));
  refined.points.col(refined.cells(0, 0)).setConstant(10);  // inverts a coarse cell
  EXPECT_FALSE(coarse_mesh(refined));
}

TEST_IN_2D_AND_3D(NestedMeshTest, OtherMeshesAreNotRecognized) {
  const auto mesh = make_sample<Dim>(Shape::kBox, 4, 0.2).mesh;
  EXPECT_FALSE(coarse_mesh(mesh));
  const auto refined = refine(mesh);
  const auto changed = [&](const auto& change) {
    auto other = refined;
    change(other.cells);
    return coarse_mesh(other).has_value();
  };
  EXPECT_TRUE(changed([](auto&) {}));
  EXPECT_FALSE(changed([](auto& cells) { cells.col(0).swap(cells.col(1)); }));
  EXPECT_FALSE(changed([](auto& cells) { cells.col(Dim + 1).swap(cells.col(0)); }));
  EXPECT_FALSE(changed([](auto& cells) { cells.row(0).swap(cells.row(1)); }));
  EXPECT_FALSE(changed([](auto& cells) {
    const auto all = cells.eval();
    cells = all.leftCols(all.cols() - 1);
  }));
}

}  // namespace
}  // namespace flbc::testing
