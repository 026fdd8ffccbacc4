// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Cages with more control points than the coarse shapes have corners.
#pragma once

#include "support/test.h"

namespace flbc::testing {

//! The boundary of a mesh as a cage, oriented outward.
template <int Dim>
Cage<Dim> boundary_as_cage(const DomainMesh<Dim>& mesh) {
  const auto topology = build_topology(mesh);
  std::vector<Index> number(mesh.num_vertices(), -1);
  Cage<Dim> cage;
  cage.points.resize(Dim, mesh.num_vertices());
  cage.facets.resize(Dim, topology.num_facets());
  Index num_points = 0;
  Index num_facets = 0;
  for (Index f = 0; f < topology.num_facets(); ++f) {
    if (!topology.is_boundary(f)) continue;
    auto facet = topology.facets.col(f);
    const Vector<Dim> inside =
        mesh.points(Eigen::all, mesh.cells.col(topology.sides(0, f))).rowwise().mean();
    Eigen::Matrix<double, Dim, Dim> edges;
    for (int k = 1; k < Dim; ++k) {
      edges.col(k - 1) = mesh.points.col(facet[k]) - mesh.points.col(facet[0]);
    }
    edges.col(Dim - 1) = inside - mesh.points.col(facet[0]);
    const bool is_inwards = Dim == 2 ? edges.determinant() < 0 : edges.determinant() > 0;
    for (int k = 0; k < Dim; ++k) {
      const Index v = facet[is_inwards && k < 2 ? 1 - k : k];
      if (number[v] < 0) {
        number[v] = num_points;
        cage.points.col(num_points++) = mesh.points.col(v);
      }
      cage.facets(k, num_facets) = number[v];
    }
    ++num_facets;
  }
  cage.points.conservativeResize(Eigen::NoChange, num_points);
  cage.facets.conservativeResize(Eigen::NoChange, num_facets);
  return cage;
}

//! A shape whose cage is subdivided. \param cage_subdivisions  divides `subdivisions`
template <int Dim>
Sample<Dim> with_fine_cage(Shape shape, Index cage_subdivisions, Index subdivisions) {
  if (subdivisions % cage_subdivisions != 0) {
    throw std::invalid_argument("the mesh has to refine the cage");
  }
  auto sample = make_sample<Dim>(shape, subdivisions, 0.2);
  sample.cage = boundary_as_cage(make_sample<Dim>(shape, cage_subdivisions).mesh);
  return sample;
}

}  // namespace flbc::testing
