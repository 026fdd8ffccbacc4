// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/domain_mesh.h"

#include "support/test.h"

namespace flbc::testing {
namespace {

template <int Dim>
void expect_refused(DomainMesh<Dim> mesh, const std::string& words) {
  expect_error<InputError>([&] { normalize_and_validate(mesh); }, {words});
}

TEST_IN_2D_AND_3D(DomainMeshTest, TopologyIsConsistent) {
  for (const auto& sample : samples<Dim>()) {
    SCOPED_TRACE(sample.name);
    const auto& mesh = sample.mesh;
    const auto topology = build_topology(mesh);
    std::vector<int> visits(topology.num_facets(), 0);
    for (Index s = 0; s < mesh.num_cells(); ++s) {
      for (int k = 0; k <= Dim; ++k) {
        const Index f = topology.cell_facets(k, s);
        ++visits[f];
        EXPECT_TRUE(topology.sides(0, f) == s || topology.sides(1, f) == s);
        for (const Index v : topology.facets.col(f)) {
          EXPECT_NE(v, mesh.cells(k, s));
          EXPECT_TRUE((mesh.cells.col(s).array() == v).any());
        }
      }
    }
    for (Index f = 0; f < topology.num_facets(); ++f) {
      EXPECT_EQ(visits[f], topology.is_boundary(f) ? 1 : 2);
    }
  }
}

TEST_IN_2D_AND_3D(DomainMeshTest, TurnsCellsRound) {
  auto mesh = make_sample<Dim>(Shape::kBox, 2).mesh;
  std::swap(mesh.cells(0, 1), mesh.cells(1, 1));
  ASSERT_LT(signed_measure(mesh, 1), 0);
  normalize_and_validate(mesh);
  EXPECT_GT(signed_measure(mesh, 1), 0);
}

// The second one moved.
template <int Dim>
DomainMesh<Dim> joined(const DomainMesh<Dim>& a, const DomainMesh<Dim>& b, double distance) {
  DomainMesh<Dim> both{PointList<Dim>(Dim, a.num_vertices() + b.num_vertices()),
                       CellList<Dim>(Dim + 1, a.num_cells() + b.num_cells())};
  both.points << a.points, (b.points.array() + distance).matrix();
  both.cells << a.cells, (b.cells.array() + a.num_vertices()).matrix();
  return both;
}

TEST_IN_2D_AND_3D(DomainMeshTest, NamesDefects) {
  const auto sound = make_sample<Dim>(Shape::kBox, 2).mesh;
  expect_refused(DomainMesh<Dim>{}, "no cells");

  auto mesh = sound;
  mesh.points(0, 1) = std::numeric_limits<double>::quiet_NaN();
  expect_refused(mesh, "vertex 1 of the domain mesh is not finite");

  mesh = sound;
  mesh.cells(0, 3) = 1000;
  expect_refused(mesh, "cell 3 of the domain mesh refers to vertex 1000");

  mesh = sound;
  mesh.cells(0, 3) = mesh.cells(1, 3);
  expect_refused(mesh, "cell 3 of the domain mesh is degenerate");

  mesh = sound;
  mesh.points.conservativeResize(Dim, mesh.points.cols() + 1);
  mesh.points.rightCols(1).setConstant(0.5);
  expect_refused(mesh, "belongs to no cell");

  mesh = sound;  // one cell thrice
  mesh.cells.conservativeResize(Dim + 1, mesh.cells.cols() + 2);
  mesh.cells.rightCols(2).colwise() = sound.cells.col(0);
  expect_refused(mesh, "share one facet");

  mesh = sound;  // the center vertex beyond the boundary: cells fold over each other
  Index inner = 0;
  (sound.points.colwise() - Vector<Dim>::Constant(0.5)).colwise().norm().minCoeff(&inner);
  mesh.points.col(inner).setConstant(3);
  expect_refused(mesh, "overlap");

  mesh = joined(sound, sound, 10);  // disjoint: two parts are not a defect
  EXPECT_NO_THROW(normalize_and_validate(mesh));

  mesh = joined(sound, sound, 1);  // they share a corner, and that alone
  const auto corner = [&](double x) {
    Index vertex = 0;
    (mesh.points.colwise() - Vector<Dim>::Constant(x)).colwise().norm().minCoeff(&vertex);
    return vertex;
  };
  const Index first = corner(1);
  mesh.points.col(first).setConstant(100);
  const Index second = corner(1);
  mesh.points.col(first).setConstant(1);
  for (Index& v : mesh.cells.reshaped()) v = v == second ? first : v;
  const Index last = mesh.num_vertices() - 1;
  mesh.points.col(second) = mesh.points.col(last);
  for (Index& v : mesh.cells.reshaped()) v = v == last ? second : v;
  mesh.points.conservativeResize(Dim, last);
  expect_refused(mesh, "merely touch, at (1, 1");
}

// Found by several threads, each in its part of the mesh.
TEST_IN_2D_AND_3D(DomainMeshTest, NamesTheFirstOfManyDefectsForAnyNumberOfThreads) {
  const auto sound = make_sample<Dim>(Shape::kBox, Dim == 2 ? 40 : 12).mesh;
  ASSERT_GT(sound.num_vertices(), 1500);
  const Index many = sound.num_cells();
  for (const int threads : {1, 2, 5}) {
    const ThreadScope scope(threads);
    auto mesh = sound;
    for (const Index s : {many - 3, many / 2, 77}) mesh.cells(0, s) = mesh.cells(1, s);
    expect_refused(mesh, "cell 77 of the domain mesh is degenerate");

    mesh = sound;
    mesh.cells.conservativeResize(Dim + 1, many + 4);
    for (const Index k : {0, 1}) mesh.cells.col(many + k) = sound.cells.col(many - 1);
    for (const Index k : {2, 3}) mesh.cells.col(many + k) = sound.cells.col(0);
    expect_refused(mesh, "cells 0, " + std::to_string(many + 2) + " and " +
                             std::to_string(many + 3) + " of the domain mesh share one facet");
  }
}

}  // namespace
}  // namespace flbc::testing
