// SPDX-License-Identifier: BSD-3-Clause
#include "problem/geodesic/reflex_edges.h"

#include <algorithm>

#include <Eigen/Geometry>

namespace flbc::distance {
namespace {

// An edge of a boundary facet.
struct FacetAtEdge {
  Index low, high;  // its vertices
  Index apex;       // the facet's third vertex
  Index inside;     // the vertex of the cell behind it

  bool is_on_same_edge(const FacetAtEdge& other) const {
    return low == other.low && high == other.high;
  }
  bool operator<(const FacetAtEdge& other) const {
    return low != other.low ? low < other.low : high < other.high;
  }
};

std::vector<FacetAtEdge> boundary_sides(const DomainMesh<3>& mesh,
                                        const MeshTopology<3>& topology) {
  std::vector<FacetAtEdge> sides;
  for (Index f = 0; f < topology.num_facets(); ++f) {
    if (!topology.is_boundary(f)) continue;
    const Index cell = topology.sides(0, f);
    Index opposite = 0;
    topology.cell_facets.col(cell).cwiseEqual(f).maxCoeff(&opposite);
    for (int k = 0; k < 3; ++k) {
      const auto [low, high] = std::minmax(topology.facets(k, f), topology.facets((k + 1) % 3, f));
      sides.push_back({low, high, topology.facets((k + 2) % 3, f), mesh.cells(opposite, cell)});
    }
  }
  std::sort(sides.begin(), sides.end());
  return sides;
}

// Whether the other facet turns away from the inside, by more than rounding.
bool is_reflex(const DomainMesh<3>& mesh, const FacetAtEdge& side, const FacetAtEdge& other) {
  constexpr double kFlat = 1e-6;
  const auto edge = [&](Index v) -> Vector<3> {
    return (mesh.points.col(v) - mesh.points.col(side.low)).normalized();
  };
  const Vector<3> normal = edge(side.high).cross(edge(side.apex)).normalized();
  const double inside = normal.dot(edge(side.inside));
  const double apex = normal.dot(edge(other.apex));
  return inside > 0 ? apex < -kFlat : apex > kFlat;
}

}  // namespace

std::vector<std::uint8_t> on_reflex_edges(const DomainMesh<3>& mesh,
                                          const MeshTopology<3>& topology) {
  std::vector<std::uint8_t> reflex(mesh.num_vertices(), 0);
  const auto sides = boundary_sides(mesh, topology);
  for (std::size_t k = 0; k + 1 < sides.size(); ++k) {
    if (!sides[k].is_on_same_edge(sides[k + 1])) continue;
    if (!is_reflex(mesh, sides[k], sides[k + 1])) continue;
    reflex[sides[k].low] = 1;
    reflex[sides[k].high] = 1;
  }
  return reflex;
}

}  // namespace flbc::distance
