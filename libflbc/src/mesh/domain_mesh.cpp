// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/domain_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <string>
#include <vector>

#include <Eigen/LU>

#include "base/messages.h"
#include "base/union_find.h"
#include "flbc/errors.h"

namespace flbc {
namespace {

// A cell's facet opposite to vertex `opposite`, vertices sorted, as the key by which both sides of
// a facet find each other.
template <int Dim>
struct HalfFacet {
  std::array<Index, Dim> key;
  Index cell;
  Index opposite;
};

template <int Dim>
HalfFacet<Dim> half_facet(const CellList<Dim>& cells, Index cell, Index opposite) {
  HalfFacet<Dim> result{{}, cell, opposite};
  for (Index k = 0, slot = 0; k <= Dim; ++k) {
    if (k != opposite) result.key[slot++] = cells(k, cell);
  }
  std::sort(result.key.begin(), result.key.end());
  return result;
}

// Bucket sort by the smallest vertex keeps this linear; buckets hold a few dozen facets.
template <int Dim>
std::vector<HalfFacet<Dim>> sorted_half_facets(const CellList<Dim>& cells, Index num_vertices) {
  const Index num_cells = static_cast<Index>(cells.cols());
  std::vector<Index> start(num_vertices + 1, 0);
  for (Index s = 0; s < num_cells; ++s) {
    for (Index k = 0; k <= Dim; ++k) ++start[half_facet<Dim>(cells, s, k).key[0] + 1];
  }
  std::partial_sum(start.begin(), start.end(), start.begin());
  std::vector<HalfFacet<Dim>> sorted(start.back());
  std::vector<Index> next(start.begin(), start.end() - 1);
  for (Index s = 0; s < num_cells; ++s) {
    for (Index k = 0; k <= Dim; ++k) {
      const auto facet = half_facet<Dim>(cells, s, k);
      sorted[next[facet.key[0]]++] = facet;
    }
  }
  for (Index v = 0; v < num_vertices; ++v) {
    std::sort(sorted.begin() + start[v], sorted.begin() + start[v + 1],
              [](const auto& a, const auto& b) {
                return a.key != b.key ? a.key < b.key : a.cell < b.cell;
              });
  }
  return sorted;
}

template <int Dim>
void check_numbers(const DomainMesh<Dim>& mesh) {
  if (mesh.num_cells() == 0) throw InputError("the domain mesh has no cells");
  for (Index v = 0; v < mesh.num_vertices(); ++v) {
    if (!mesh.points.col(v).allFinite()) {
      throw InputError("vertex " + std::to_string(v) +
                       " of the domain mesh is not finite: " + format_point(mesh.points.col(v)));
    }
  }
  for (Index s = 0; s < mesh.num_cells(); ++s) {
    for (Index k = 0; k <= Dim; ++k) {
      const Index v = mesh.cells(k, s);
      if (v < 0 || v >= mesh.num_vertices()) {
        throw InputError("cell " + std::to_string(s) + " of the domain mesh refers to vertex " +
                         std::to_string(v) + ", but there are " +
                         std::to_string(mesh.num_vertices()) + " vertices");
      }
    }
  }
}

template <int Dim>
void orient_cells(DomainMesh<Dim>& mesh) {
  for (Index s = 0; s < mesh.num_cells(); ++s) {
    const double measure = signed_measure(mesh, s);
    double longest = 0;
    for (int k = 1; k <= Dim; ++k) {
      longest = std::max(
          longest, (mesh.points.col(mesh.cells(k, s)) - mesh.points.col(mesh.cells(0, s))).norm());
    }
    // Below this the gradients on the cell are rounding errors.
    if (!(std::abs(measure) > 1e-14 * std::pow(longest, Dim))) {
      throw InputError("cell " + std::to_string(s) + " of the domain mesh is degenerate, at " +
                       format_point(mesh.points.col(mesh.cells(0, s))));
    }
    if (measure < 0) std::swap(mesh.cells(Dim - 1, s), mesh.cells(Dim, s));
  }
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

// Cells on the same side of their common facet lie on top of each other.
template <int Dim>
void check_unfolded(const DomainMesh<Dim>& mesh, const MeshTopology<Dim>& topology) {
  const auto opposite = [&](Index facet, Index cell) {
    Index corner = 0;
    while (topology.cell_facets(corner, cell) != facet) ++corner;
    return mesh.cells(corner, cell);
  };
  for (Index f = 0; f < topology.num_facets(); ++f) {
    if (topology.is_boundary(f)) continue;
    const Index a = topology.sides(0, f);
    const Index b = topology.sides(1, f);
    const Eigen::Matrix<Index, Dim, 1> facet = topology.facets.col(f);
    if (is_above(mesh, facet, opposite(f, a)) != is_above(mesh, facet, opposite(f, b))) continue;
    throw InputError("cells " + std::to_string(a) + " and " + std::to_string(b) +
                     " of the domain mesh overlap: they lie on the same side of their common " +
                     (Dim == 2 ? "edge" : "face") + ", at " +
                     format_point(mesh.points.col(facet[0])));
  }
}

// Cells that meet in a vertex must be connected through facets, near it or elsewhere: otherwise two
// parts only touch there.
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
MeshTopology<Dim> build_topology(const DomainMesh<Dim>& mesh) {
  const auto half_facets = sorted_half_facets<Dim>(mesh.cells, mesh.num_vertices());

  // Facets are numbered in the order of the cells that first meet them, so that a sweep over facets
  // touches cells in memory order.
  std::vector<Index> twin((Dim + 1) * static_cast<std::size_t>(mesh.num_cells()), -1);
  const auto slot = [](const HalfFacet<Dim>& h) {
    return static_cast<std::size_t>(Dim + 1) * h.cell + h.opposite;
  };
  for (std::size_t i = 0; i + 1 < half_facets.size(); ++i) {
    const auto& a = half_facets[i];
    const auto& b = half_facets[i + 1];
    if (a.key != b.key) continue;
    if (twin[slot(a)] >= 0) {
      throw InputError("cells " + std::to_string(half_facets[i - 1].cell) + ", " +
                       std::to_string(a.cell) + " and " + std::to_string(b.cell) +
                       " of the domain mesh share one facet, at " +
                       format_point(mesh.points.col(a.key[0])));
    }
    twin[slot(a)] = static_cast<Index>(slot(b));
    twin[slot(b)] = static_cast<Index>(slot(a));
  }

  const auto num_half = static_cast<Index>(twin.size());
  const auto num_boundary = static_cast<Index>(std::count(twin.begin(), twin.end(), -1));
  MeshTopology<Dim> topology;
  topology.facets.resize(Dim, (num_half + num_boundary) / 2);
  topology.sides.resize(2, topology.facets.cols());
  topology.cell_facets.resize(Dim + 1, mesh.num_cells());
  Index next = 0;
  for (Index h = 0; h < num_half; ++h) {
    const Index cell = h / (Dim + 1);
    const Index opposite = h % (Dim + 1);
    if (twin[h] >= 0 && twin[h] < h) {
      topology.cell_facets(opposite, cell) =
          topology.cell_facets(twin[h] % (Dim + 1), twin[h] / (Dim + 1));
      continue;
    }
    for (Index k = 0, row = 0; k <= Dim; ++k) {
      if (k != opposite) topology.facets(row++, next) = mesh.cells(k, cell);
    }
    topology.sides(0, next) = cell;
    topology.sides(1, next) = twin[h] >= 0 ? twin[h] / (Dim + 1) : -1;
    topology.cell_facets(opposite, cell) = next++;
  }
  return topology;
}

template <int Dim>
std::vector<bool> boundary_vertices(const MeshTopology<Dim>& topology, Index num_vertices) {
  std::vector<bool> on_boundary(num_vertices, false);
  for (Index f = 0; f < topology.num_facets(); ++f) {
    if (!topology.is_boundary(f)) continue;
    for (int k = 0; k < Dim; ++k) on_boundary[topology.facets(k, f)] = true;
  }
  return on_boundary;
}

template <int Dim>
double signed_measure(const DomainMesh<Dim>& mesh, Index cell) {
  Eigen::Matrix<double, Dim, Dim> edges;
  for (int k = 0; k < Dim; ++k) {
    edges.col(k) = mesh.points.col(mesh.cells(k + 1, cell)) - mesh.points.col(mesh.cells(0, cell));
  }
  return edges.determinant() / (Dim == 2 ? 2 : 6);
}

template <int Dim>
void normalize_and_validate(DomainMesh<Dim>& mesh) {
  check_numbers(mesh);
  orient_cells(mesh);
  check_all_vertices_used(mesh);
  const auto topology = build_topology(mesh);
  check_unfolded(mesh, topology);
  check_no_touching(mesh, topology);
}

#define FLBC_INSTANTIATE(Dim)                                                    \
  template MeshTopology<Dim> build_topology(const DomainMesh<Dim>&);             \
  template std::vector<bool> boundary_vertices(const MeshTopology<Dim>&, Index); \
  template double signed_measure(const DomainMesh<Dim>&, Index);                 \
  template void normalize_and_validate(DomainMesh<Dim>&);
FLBC_INSTANTIATE(2)
FLBC_INSTANTIATE(3)
#undef FLBC_INSTANTIATE

}  // namespace flbc
