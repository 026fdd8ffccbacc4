// SPDX-License-Identifier: BSD-3-Clause
// What damaged arguments of public functions once broke. python/tests/test_mutations.py damages
// more.
#include <functional>

#include "flbc/cage_facts.h"
#include "flbc/gradients.h"
#include "flbc/pointwise.h"
#include "flbc/solver.h"
#include "support/test.h"

namespace flbc::testing {
namespace {

template <int Dim>
Sample<Dim> corner() {
  return make_sample<Dim>(Shape::kCorner, 2, 0.1);
}

TEST_IN_2D_AND_3D(FuzzFound, FacetsOfTheCageAreChecked) {
  const auto sample = corner<Dim>();
  auto cage = sample.cage;
  cage.facets(0, 1) = cage.size();
  for (const auto& use : std::vector<std::function<void()>>{
           [&] { mean_value_coordinates(cage, sample.mesh.points); },
           [&] { maximum_likelihood_coordinates(cage, sample.mesh.points); },
           [&] { points_outside(cage, sample.mesh.points); }, [&] { thinnest_place(cage); },
           [&] { place_points(cage, sample.mesh.points); },
           [&] { make_problem(cage, sample.mesh, DistanceScheme::kSquare, 0); }}) {
    expect_error<InputError>(use,
                             {" 1 ", "refers to control point " + std::to_string(cage.size())});
  }
  cage = sample.cage;
  cage.points(0, 2) = std::nan("");
  expect_error<InputError>([&] { place_points(cage, sample.mesh, sample.mesh.points); },
                           {"control point 2", "not finite"});
}

TEST_IN_2D_AND_3D(FuzzFound, CellsOfTheMeshAreChecked) {
  const auto sample = corner<Dim>();
  auto mesh = sample.mesh;
  mesh.cells(1, 3) = -1;
  const auto weights = WeightMatrix::Zero(sample.cage.size(), mesh.num_vertices()).eval();
  for (const auto& use : std::vector<std::function<void()>>{
           [&] { build_topology(mesh); }, [&] { count_parts(mesh); }, [&] { mesh_parts(mesh); },
           [&] { locate_points(mesh, sample.mesh.points); },
           [&] { total_variation(mesh, weights); },
           [&] { vertex_gradients(mesh, SparseWeights(weights)); }}) {
    expect_error<InputError>(use, {"cell 3 of the domain mesh", "vertex -1"});
  }
}

TEST_IN_2D_AND_3D(FuzzFound, TheTopologyOfAnotherMeshIsRefused) {
  const auto sample = corner<Dim>();
  const auto& cage = sample.cage;
  const auto& mesh = sample.mesh;
  auto topology = build_topology(make_sample<Dim>(Shape::kBox, 2).mesh);
  expect_error<InputError>(
      [&] { make_problem(cage, mesh, topology, DistanceScheme::kConstant, 0); },
      {"topology is not that of the domain mesh"});
  topology = build_topology(mesh);
  std::swap(topology.cell_facets(0, 0), topology.cell_facets(1, 0));
  expect_error<InputError>(
      [&] { make_problem(cage, mesh, topology, DistanceScheme::kConstant, 0); },
      {"topology is not that of the domain mesh"});
}

TEST_IN_2D_AND_3D(FuzzFound, PlacementsWithoutAMeshHaveNoWeightsInCells) {
  const auto sample = corner<Dim>();
  const auto& cage = sample.cage;
  const auto& mesh = sample.mesh;
  const auto placement = place_points(cage, sample.mesh.points);
  const auto weights = WeightMatrix::Zero(cage.size(), mesh.num_vertices()).eval();
  expect_error<InputError>([&] { weights_at(cage, mesh, weights, placement); }, {"cell -1"});
}

// Distances of points that are far away are not finite.
TEST_IN_2D_AND_3D(FuzzFound, ThereIsANearestPlaceForEveryPoint) {
  const auto sample = corner<Dim>();
  PointList<Dim> far = sample.mesh.points.leftCols(1);
  far(0, 0) = 1e300;
  const auto& cage = sample.cage;
  EXPECT_GE(nearest_on_cage(cage, far, {0}).front().facet, 0);
  expect_error<InputError>([&] { nearest_on_cage(cage, far, {1}); }, {"no point 1"});
}

}  // namespace
}  // namespace flbc::testing
