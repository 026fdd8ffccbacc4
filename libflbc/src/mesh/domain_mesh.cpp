// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/domain_mesh.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <Eigen/LU>

#include "base/instantiate.h"
#include "base/messages.h"
#include "base/parallel.h"
#include "base/shape_checks.h"
#include "base/union_find.h"
#include "flbc/errors.h"
#include "mesh/cell_geometry.h"
#include "mesh/check_topology.h"

namespace flbc {
namespace {

// Whether the cell is so flat that its gradients are rounding errors.
template <int Dim>
bool is_degenerate(const DomainMesh<Dim>& mesh, Index cell, double measure) {
  const double longest2 = cell_edges(mesh, cell).colwise().squaredNorm().maxCoeff();
  return !(std::abs(measure) > 1e-14 * std::pow(std::sqrt(longest2), Dim));
}

template <int Dim>
void orient_cells(DomainMesh<Dim>& mesh) {
  for (Index s = 0; s < mesh.num_cells(); ++s) {
    if (signed_measure(mesh, s) < 0) std::swap(mesh.cells(Dim - 1, s), mesh.cells(Dim, s));
  }
}

template <int Dim>
void check_oriented(const DomainMesh<Dim>& mesh) {
  const Index bad = first_where(mesh.num_cells(), [&](Index s) {
    const double measure = signed_measure(mesh, s);
    return measure <= 0 || is_degenerate(mesh, s, measure);
  });
  if (bad == mesh.num_cells()) return;
  const bool inverted = !is_degenerate(mesh, bad, signed_measure(mesh, bad));
  throw InputError("cell " + std::to_string(bad) + " of the domain mesh is " +
                   (inverted ? "inverted" : "degenerate") + ", at " +
                   format_point(mesh.points.col(mesh.cells(0, bad))) +
                   (inverted ? "; normalize_and_validate() orients cells" : ""));
}

template <int Dim>
void check_all_vertices_used(const DomainMesh<Dim>& mesh) {
  std::vector<bool> used(mesh.num_vertices(), false);
  for (const Index v : mesh.cells.reshaped()) used[v] = true;
  const auto unused = std::find(used.begin(), used.end(), false);
  if (unused == used.end()) return;
  const auto v = static_cast<Index>(unused - used.begin());
  throw InputError("vertex " + std::to_string(v) + " of the domain mesh at " +
                   format_point(mesh.points.col(v)) + " belongs to no cell");
}

// Each corner of a cell has the facet of the other corners, and the cell is on one of its sides.
template <int Dim>
bool has_its_facets(const DomainMesh<Dim>& mesh, const MeshTopology<Dim>& topology, Index cell) {
  for (Index k = 0; k <= Dim; ++k) {
    const Index f = topology.cell_facets(k, cell);
    if (f < 0 || f >= topology.num_facets()) return false;
    if ((topology.sides.col(f).array() == cell).count() != 1) return false;
    for (Index j = 0; j <= Dim; ++j) {
      const auto found = (topology.facets.col(f).array() == mesh.cells(j, cell)).count();
      if (found != (j == k ? 0 : 1)) return false;
    }
  }
  return true;
}

// On which side of the facet the vertex lies.
template <int Dim>
bool is_above(const DomainMesh<Dim>& mesh, const Eigen::Matrix<Index, Dim, 1>& facet,
              Index opposite) {
  Eigen::Matrix<double, Dim, Dim> edges;
  for (int k = 1; k < Dim; ++k) {
    edges.col(k - 1) = mesh.points.col(facet[k]) - mesh.points.col(facet[0]);
  }
  edges.col(Dim - 1) = mesh.points.col(opposite) - mesh.points.col(facet[0]);
  return edges.determinant() > 0;
}

// Cells on the same side of their common facet overlap.
template <int Dim>
void check_unfolded(const DomainMesh<Dim>& mesh, const MeshTopology<Dim>& topology) {
  const auto opposite = [&](Index facet, Index cell) {
    Index corner = 0;
    while (topology.cell_facets(corner, cell) != facet) ++corner;
    return mesh.cells(corner, cell);
  };
  const Index bad = first_where(topology.num_facets(), [&](Index f) {
    if (topology.is_boundary(f)) return false;
    const Eigen::Matrix<Index, Dim, 1> facet = topology.facets.col(f);
    return is_above(mesh, facet, opposite(f, topology.sides(0, f))) ==
           is_above(mesh, facet, opposite(f, topology.sides(1, f)));
  });
  if (bad == topology.num_facets()) return;
  throw InputError("cells " + std::to_string(topology.sides(0, bad)) + " and " +
                   std::to_string(topology.sides(1, bad)) +
                   " of the domain mesh overlap: they lie on the same side of their common " +
                   (Dim == 2 ? "edge" : "face") + ", at " +
                   format_point(mesh.points.col(topology.facets(0, bad))));
}

// Cells that share a vertex must be connected through facets somewhere; otherwise two parts touch
// only at the vertex.
template <int Dim>
void check_no_touching(const DomainMesh<Dim>& mesh, const MeshTopology<Dim>& topology) {
  UnionFind parts(mesh.num_cells());
  for (const auto& sides : topology.sides.colwise()) {
    if (sides[1] >= 0) parts.unite(sides[0], sides[1]);
  }
  std::vector<Index> cell_at(mesh.num_vertices(), -1);
  for (Index s = 0; s < mesh.num_cells(); ++s) {
    for (const Index v : mesh.cells.col(s)) {
      if (cell_at[v] < 0) cell_at[v] = s;
      if (parts.find(cell_at[v]) == parts.find(s)) continue;
      throw InputError("the domain is not connected: cells " + std::to_string(cell_at[v]) +
                       " and " + std::to_string(s) + " belong to parts that merely touch, at " +
                       format_point(mesh.points.col(v)));
    }
  }
}

}  // namespace

template <int Dim>
void check_topology(const DomainMesh<Dim>& mesh, const MeshTopology<Dim>& topology) {
  check_indices(mesh.cells, mesh.num_vertices(), kMeshNames);
  bool fits = topology.sides.cols() == topology.num_facets() &&
              topology.cell_facets.cols() == mesh.num_cells();
  fits = fits && first_where(mesh.num_cells(), [&](Index s) {
                   return !has_its_facets(mesh, topology, s);
                 }) == mesh.num_cells();
  // No facet has other sides.
  const auto num_sides = (topology.sides.array() >= 0).count();
  if (fits && num_sides == (Dim + 1) * Eigen::Index{mesh.num_cells()} &&
      (topology.sides.row(0).array() >= 0).all()) {
    return;
  }
  throw InputError("the topology is not that of the domain mesh; build_topology() makes it");
}

template <int Dim>
double signed_measure(const DomainMesh<Dim>& mesh, Index cell) {
  return cell_edges(mesh, cell).determinant() / (Dim == 2 ? 2 : 6);
}

template <int Dim>
void validate(const DomainMesh<Dim>& mesh) {
  check_elements(mesh.points, mesh.cells, kMeshNames);
  check_oriented(mesh);
  check_all_vertices_used(mesh);
}

template <int Dim>
void validate(const DomainMesh<Dim>& mesh, const MeshTopology<Dim>& topology) {
  check_topology(mesh, topology);
  check_unfolded(mesh, topology);
  check_no_touching(mesh, topology);
}

template <int Dim>
void normalize_and_validate(DomainMesh<Dim>& mesh) {
  check_elements(mesh.points, mesh.cells, kMeshNames);
  orient_cells(mesh);
  validate(mesh);
  validate(mesh, build_topology(mesh));
}

FLBC_INSTANTIATE_FUNCTION(check_topology)
FLBC_INSTANTIATE_FUNCTION(signed_measure)
template void validate(const DomainMesh<2>&);
template void validate(const DomainMesh<3>&);
template void validate(const DomainMesh<2>&, const MeshTopology<2>&);
template void validate(const DomainMesh<3>&, const MeshTopology<3>&);
FLBC_INSTANTIATE_FUNCTION(normalize_and_validate)

}  // namespace flbc
