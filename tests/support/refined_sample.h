// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Samples with refined meshes, and with more control points than their shapes have corners.
#pragma once

#include "flbc/nested_mesh.h"
#include "support/solver_options.h"
#include "support/test.h"

namespace flbc::testing {

//! A sample on the refinement of its mesh.
template <int Dim>
Sample<Dim> refined_sample(Shape shape, Index resolution) {
  auto sample = make_sample<Dim>(shape, resolution, 0.2);
  sample.mesh = refine(sample.mesh);
  return sample;
}

//! A shape whose cage is subdivided. \param cage_subdivisions  divides `subdivisions`
template <int Dim>
Sample<Dim> with_fine_cage(Shape shape, Index cage_subdivisions, Index subdivisions) {
  if (subdivisions % cage_subdivisions != 0) {
    throw std::invalid_argument("the mesh has to refine the cage");
  }
  auto sample = make_sample<Dim>(shape, subdivisions, 0.2);
  sample.cage = boundary_of(make_sample<Dim>(shape, cage_subdivisions).mesh);
  return sample;
}

//! The same cells in an order in which the mesh is not recognized as refined.
template <int Dim>
DomainMesh<Dim> in_other_order(DomainMesh<Dim> mesh) {
  mesh.cells.col(0).swap(mesh.cells.col(1));
  return mesh;
}

//! Solves from a coarse mesh, cold, and by problems that were made before, with their phi or with
//! given functions.
//! \param expect_optimal  gets the name of each way and its solution
template <int Dim, class Expect>
void solve_in_every_way(const Sample<Dim>& sample, const SolverOptions& options,
                        const Expect& expect_optimal) {
  const auto solution = solve(sample.cage, sample.mesh, options);
  EXPECT_EQ(solution.report.coarse_levels.size(), 1u);
  expect_optimal("from the coarse mesh", solution);
  expect_optimal("cold", solve(sample.cage, in_other_order(sample.mesh), options));
  const auto plain = smooth_problem(sample);
  expect_optimal("a problem without", solve(plain, options));
  auto given = plain;
  given.phi = WeightFunctions(plain.phi.dense());
  expect_optimal("given phi", solve(given, options));
}

}  // namespace flbc::testing
