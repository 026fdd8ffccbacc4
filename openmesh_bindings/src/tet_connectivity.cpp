// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/openmesh/tet_connectivity.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace flbc::openmesh {
namespace {

using Edge = std::pair<Index, Index>;

// Sorted pairs of vertices, the smaller one first.
std::vector<Edge> sorted_edges(const CellList<3>& cells) {
  std::vector<Edge> edges;
  edges.reserve(static_cast<std::size_t>(6 * cells.cols()));
  for (const auto& cell : cells.colwise()) {
    for (int a = 0; a < 4; ++a) {
      for (int b = a + 1; b < 4; ++b) edges.emplace_back(std::minmax(cell[a], cell[b]));
    }
  }
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  return edges;
}

// Orients each facet outward from its first cell. Facets list the vertices in the order of that
// cell.
void orient(MeshTopology<3>& topology) {
  for (Index f = 0; f < topology.num_facets(); ++f) {
    const auto facets = topology.cell_facets.col(topology.sides(0, f));
    if (facets[1] == f || facets[3] == f) std::swap(topology.facets(1, f), topology.facets(2, f));
  }
}

// Groups items by vertex in the given order. `visit` calls its argument for each (vertex, item).
template <class Neighbors, class Visit>
void group(Index num_vertices, const Visit& visit, Neighbors& neighbors) {
  auto& starts = neighbors.starts;
  starts.assign(static_cast<std::size_t>(num_vertices) + 1, 0);
  visit([&](Index vertex, Index) { ++starts[vertex + 1]; });
  std::partial_sum(starts.begin(), starts.end(), starts.begin());
  neighbors.items.resize(static_cast<std::size_t>(starts.back()));
  auto next = starts;
  visit([&](Index vertex, Index item) { neighbors.items[next[vertex]++] = item; });
}

}  // namespace

TetConnectivity::TetConnectivity(const DomainMesh<3>& mesh)
    : cells_(mesh.cells),
      topology_(build_topology(mesh)),
      boundary_vertices_(flbc::boundary_vertices(topology_, mesh.num_vertices())) {
  orient(topology_);
  const auto edges = sorted_edges(cells_);
  const auto num_edges = static_cast<Index>(edges.size());
  edges_.resize(2, num_edges);
  for (Index e = 0; e < num_edges; ++e) edges_.col(e) << edges[e].first, edges[e].second;
  const auto visit_cells = [&](const auto& visit) {
    for (Index s = 0; s < mesh.num_cells(); ++s) {
      for (const Index vertex : cells_.col(s)) visit(vertex, s);
    }
  };
  const auto visit_edges = [&](const auto& visit) {
    for (Index e = 0; e < num_edges; ++e) visit(edges_(0, e), e), visit(edges_(1, e), e);
  };
  group(mesh.num_vertices(), visit_cells, vertex_cells_);
  group(mesh.num_vertices(), visit_edges, vertex_edges_);
  vertex_vertices_ = {vertex_edges_.starts, vertex_edges_.items};
  for (const auto vertex : vertices()) {
    for (int k = vertex_edges_.starts[vertex.idx()]; k < vertex_edges_.starts[vertex.idx() + 1];
         ++k) {
      const auto ends = edges_.col(vertex_edges_.items[k]);
      vertex_vertices_.items[k] = ends[0] == vertex.idx() ? ends[1] : ends[0];
    }
  }
  boundary_edges_.assign(edges.size(), false);
  for (const FaceHandle face : faces()) {
    if (!is_boundary(face)) continue;
    const auto v = fv_range(face);
    for (std::size_t k = 0; k < 3; ++k) {
      boundary_edges_[find_edge(v[k], v[(k + 1) % 3]).idx()] = true;
    }
  }
}

bool TetConnectivity::is_boundary(CellHandle cell) const {
  const auto faces = cf_range(cell);
  return std::any_of(faces.begin(), faces.end(),
                     [&](FaceHandle face) { return is_boundary(face); });
}

TetConnectivity::EdgeHandle TetConnectivity::find_edge(VertexHandle a, VertexHandle b) const {
  const Edge wanted = std::minmax(a.idx(), b.idx());
  const auto ends = [&](EdgeHandle edge) {
    return Edge(edges_(0, edge.idx()), edges_(1, edge.idx()));
  };
  const auto at = ve_range(VertexHandle(wanted.first));
  const auto found =
      std::lower_bound(at.begin(), at.end(), wanted,
                       [&](EdgeHandle edge, const Edge& other) { return ends(edge) < other; });
  return found != at.end() && ends(*found) == wanted ? *found : EdgeHandle();
}

}  // namespace flbc::openmesh
