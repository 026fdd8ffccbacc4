// SPDX-License-Identifier: BSD-3-Clause
// Facets of a mesh and the cells on their sides.
#include <algorithm>
#include <array>
#include <string>
#include <utility>
#include <vector>

#include "base/instantiate.h"
#include "base/messages.h"
#include "base/parallel.h"
#include "base/shape_checks.h"
#include "flbc/domain_mesh.h"
#include "flbc/errors.h"
#include "mesh/vertex_cells.h"

namespace flbc {
namespace {

// A slot is a facet of a cell: (Dim + 1) * cell + the corner opposite to the facet.
template <int Dim>
Index slot_of(Index cell, Index corner) {
  return (Dim + 1) * cell + corner;
}

// A slot with the sorted facet vertices except the smallest. This key matches the two slots of a
// facet among all slots with the same smallest vertex.
template <int Dim>
struct KeyedSlot {
  std::array<Index, Dim - 1> key;
  Index slot;
  bool operator<(const KeyedSlot& other) const {
    return key != other.key ? key < other.key : slot < other.slot;
  }
};

template <int Dim>
std::array<Index, Dim> sorted_vertices(const CellList<Dim>& cells, Index slot) {
  std::array<Index, Dim> vertices;
  for (Index k = 0, row = 0; k <= Dim; ++k) {
    if (k != slot % (Dim + 1)) vertices[row++] = cells(k, slot / (Dim + 1));
  }
  std::sort(vertices.begin(), vertices.end());
  return vertices;
}

template <int Dim>
VertexItems<Index> slots_by_smallest_vertex(const DomainMesh<Dim>& mesh) {
  return items_by_vertex<Index>(mesh.num_vertices(), [&](const auto& visit) {
    for (Index s = 0; s < mesh.num_cells(); ++s) {
      // All facets except the opposite one contain the smallest vertex of the cell.
      Index smallest = 0;
      for (Index k = 1; k <= Dim; ++k) {
        if (mesh.cells(k, s) < mesh.cells(smallest, s)) smallest = k;
      }
      Index next = smallest == 0 ? 1 : 0;
      for (Index k = 0; k <= Dim; ++k) {
        if (k != smallest && mesh.cells(k, s) < mesh.cells(next, s)) next = k;
      }
      for (Index k = 0; k <= Dim; ++k) {
        visit(mesh.cells(k == smallest ? next : smallest, s), slot_of<Dim>(s, k));
      }
    }
  });
}

// Slots of facets with the same smallest vertex, sorted.
template <int Dim>
using SlotRange = typename VertexItems<KeyedSlot<Dim>>::Range;

template <int Dim>
[[noreturn]] void refuse_third_cell(const DomainMesh<Dim>& mesh, Index vertex,
                                    const SlotRange<Dim>& slots) {
  const KeyedSlot<Dim>* slot = slots.begin();
  while (slot[0].key != slot[2].key) ++slot;
  const auto cell = [&](int k) { return std::to_string(slot[k].slot / (Dim + 1)); };
  throw InputError("cells " + cell(0) + ", " + cell(1) + " and " + cell(2) +
                   " of the domain mesh share one facet, at " +
                   format_point(mesh.points.col(vertex)));
}

// Pairs the slots of each facet. \return whether there are at most two of each
template <int Dim>
bool pair_up(const SlotRange<Dim>& slots, std::vector<Index>& twin) {
  for (const KeyedSlot<Dim>* slot = slots.begin(); slots.end() - slot >= 2; ++slot) {
    const auto& [key, a] = slot[0];
    if (key != slot[1].key) continue;
    if (twin[a] >= 0) return false;
    const Index b = slot[1].slot;
    twin[a] = b;
    twin[b] = a;
  }
  return true;
}

// For every slot, the other slot of its facet; -1 on the boundary.
template <int Dim>
std::vector<Index> twins(const DomainMesh<Dim>& mesh) {
  auto slots = slots_by_smallest_vertex(mesh);
  VertexItems<KeyedSlot<Dim>> keyed{std::move(slots.start), {}};
  keyed.items.resize(slots.items.size());
  std::vector<Index> twin(slots.items.size(), -1);
  const Index bad = first_where(mesh.num_vertices(), [&](Index v) {
    const Index begin = keyed.start[v];
    const Index end = keyed.start[v + 1];
    for (Index k = begin; k < end; ++k) {
      const auto vertices = sorted_vertices<Dim>(mesh.cells, slots.items[k]);
      std::copy(vertices.begin() + 1, vertices.end(), keyed.items[k].key.begin());
      keyed.items[k].slot = slots.items[k];
    }
    std::sort(keyed.items.begin() + begin, keyed.items.begin() + end);
    return !pair_up<Dim>(keyed.of(v), twin);
  });
  if (bad < mesh.num_vertices()) refuse_third_cell<Dim>(mesh, bad, keyed.of(bad));
  return twin;
}

}  // namespace

template <int Dim>
MeshTopology<Dim> build_topology(const DomainMesh<Dim>& mesh) {
  check_indices(mesh.cells, mesh.num_vertices(), kMeshNames);
  const auto twin = twins(mesh);
  const auto num_slots = static_cast<Index>(twin.size());
  const auto num_boundary = static_cast<Index>(std::count(twin.begin(), twin.end(), -1));
  MeshTopology<Dim> topology;
  topology.facets.resize(Dim, (num_slots + num_boundary) / 2);
  topology.sides.resize(2, topology.facets.cols());
  topology.cell_facets.resize(Dim + 1, mesh.num_cells());
  // Facets are numbered by first occurrence in the cells, so a sweep over facets reads cells in
  // memory order.
  Index next = 0;
  for (Index slot = 0; slot < num_slots; ++slot) {
    const Index cell = slot / (Dim + 1);
    const Index opposite = slot % (Dim + 1);
    if (twin[slot] >= 0 && twin[slot] < slot) {
      topology.cell_facets(opposite, cell) =
          topology.cell_facets(twin[slot] % (Dim + 1), twin[slot] / (Dim + 1));
      continue;
    }
    for (Index k = 0, row = 0; k <= Dim; ++k) {
      if (k != opposite) topology.facets(row++, next) = mesh.cells(k, cell);
    }
    topology.sides(0, next) = cell;
    topology.sides(1, next) = twin[slot] >= 0 ? twin[slot] / (Dim + 1) : -1;
    topology.cell_facets(opposite, cell) = next++;
  }
  return topology;
}

template <int Dim>
std::vector<bool> boundary_vertices(const MeshTopology<Dim>& topology, Index num_vertices) {
  if (topology.sides.cols() != topology.num_facets()) {
    throw InputError("the topology has " + std::to_string(topology.num_facets()) +
                     " facets, but the sides of " + std::to_string(topology.sides.cols()));
  }
  check_indices(topology.facets, num_vertices, kMeshNames);
  std::vector<bool> on_boundary(num_vertices, false);
  for (Index f = 0; f < topology.num_facets(); ++f) {
    if (!topology.is_boundary(f)) continue;
    for (int k = 0; k < Dim; ++k) on_boundary[topology.facets(k, f)] = true;
  }
  return on_boundary;
}

FLBC_INSTANTIATE_FUNCTION(build_topology)
FLBC_INSTANTIATE_FUNCTION(boundary_vertices)

}  // namespace flbc
