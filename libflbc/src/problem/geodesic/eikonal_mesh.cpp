// SPDX-License-Identifier: BSD-3-Clause
#include "problem/geodesic/eikonal_mesh.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include <Eigen/Geometry>

#include "base/parallel.h"
#include "flbc/domain_mesh.h"
#include "mesh/cell_geometry.h"

namespace flbc::distance {
namespace {

// An edge of a boundary facet.
struct FacetAtEdge {
  Index low, high;  // its vertices
  Index apex;       // third vertex of the facet
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

// Whether the edge is reflex, by more than rounding.
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

// For each vertex, whether it lies on a reflex edge of the boundary.
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

// Squared lengths of a cell's edges.
template <int Dim>
struct CellLengths {
  double squared[Dim + 1][Dim + 1];

  CellLengths(const DomainMesh<Dim>& mesh, Index s) {
    const Eigen::Matrix<double, Dim, Dim + 1> corners = mesh.points(Eigen::all, mesh.cells.col(s));
    for (int k = 0; k <= Dim; ++k) {
      squared[k][k] = 0;
      for (int l = 0; l < k; ++l) {
        squared[k][l] = squared[l][k] = (corners.col(k) - corners.col(l)).squaredNorm();
      }
    }
  }

  // Product of the edges from corner `from` to k and l.
  double product(int from, int k, int l) const {
    return 0.5 * (squared[from][k] + squared[from][l] - squared[k][l]);
  }
};

// For the edge e from corner c to another corner, the maximum of -e.g over all unit vectors g in
// the cone of the cell at c. This is the maximum delay between c and the other corner for a plane
// wave through the cell to c. `one` and `two` are the remaining corners; in 2D they are equal.
template <int Dim>
double latest(const CellLengths<Dim>& lengths, int c, int other, int one, int two) {
  const double along_one = -lengths.product(c, other, one);
  const double along_two = -lengths.product(c, other, two);
  const double one2 = lengths.squared[c][one];
  const double two2 = lengths.squared[c][two];
  if (Dim == 3) {
    // The projection of -e on the plane of the two edges may lie between them.
    const double product = lengths.product(c, one, two);
    const double part_one = two2 * along_one - product * along_two;
    const double part_two = one2 * along_two - product * along_one;
    if (part_one > 0 && part_two > 0) {
      return std::sqrt((part_one * along_one + part_two * along_two) /
                       (one2 * two2 - product * product));
    }
  }
  return std::max(along_one / std::sqrt(one2), along_two / std::sqrt(two2));
}

template <int Dim>
LookBack look_back_of(const CellLengths<Dim>& lengths) {
  unsigned obtuse = 0;
  double largest = 0;
  double longest2 = 0;
  for (int c = 0; c <= Dim; ++c) {
    for (int turn = 0; turn < Dim; ++turn) {
      const auto other_of = [c](int place) { return (c + 1 + place % Dim) % (Dim + 1); };
      const int other = other_of(turn);
      const int one = other_of(turn + 1);
      const int two = other_of(turn + Dim - 1);
      if (lengths.product(c, other, one) >= 0 && lengths.product(c, other, two) >= 0) continue;
      obtuse |= 1u << (4 * other + c);
      largest = std::max(largest, latest(lengths, c, other, one, two));
      longest2 = std::max(longest2, lengths.squared[c][other]);
    }
  }
  return {static_cast<std::uint16_t>(obtuse), static_cast<float>(largest),
          static_cast<float>(longest2)};
}

Triangle triangle(double first, double second, double third, double area) {
  return {{static_cast<float>(first), static_cast<float>(second), static_cast<float>(third)},
          static_cast<float>(area)};
}

TriangleCell eikonal_cell(const DomainMesh<2>& mesh, Index s, const CellLengths<2>& lengths) {
  const auto& squared = lengths.squared;
  TriangleCell cell;
  static_cast<Triangle&>(cell) =
      triangle(squared[1][2], squared[2][0], squared[0][1], 2 * cell_geometry(mesh, s).measure);
  for (int k = 0; k < 3; ++k) cell.corners[k] = mesh.cells(k, s);
  return cell;
}

Tetrahedron eikonal_cell(const DomainMesh<3>& mesh, Index s, const CellLengths<3>& lengths) {
  constexpr int kPairs[6][2] = {{0, 1}, {0, 2}, {0, 3}, {2, 3}, {1, 3}, {1, 2}};
  Tetrahedron cell;
  const auto hat = cell_geometry(mesh, s).hat_gradients;
  for (int p = 0; p < 6; ++p) {
    const auto [k, l] = kPairs[p];
    cell.lengths2[p] = static_cast<float>(lengths.squared[k][l]);
    cell.products[p] = static_cast<float>(hat.col(k).dot(hat.col(l)));
  }
  for (int k = 0; k < 4; ++k) cell.corners[k] = mesh.cells(k, s);
  return cell;
}

template <int Dim>
VertexItems<Corner> corners_of_vertices(const DomainMesh<Dim>& mesh) {
  return items_by_vertex<Corner>(mesh.num_vertices(), [&](const auto& visit) {
    for (Index s = 0; s < mesh.num_cells(); ++s) {
      for (int k = 0; k <= Dim; ++k) visit(mesh.cells(k, s), Corner(s, k));
    }
  });
}

template <int Dim>
VertexItems<EdgeTo> edges_of_vertices(const DomainMesh<Dim>& mesh,
                                      const VertexItems<Corner>& corners) {
  VertexItems<EdgeTo> edges{{0}, {}};
  edges.start.reserve(mesh.num_vertices() + 1);
  edges.items.reserve(corners.items.size());
  std::vector<Index> seen_from(mesh.num_vertices(), -1);
  for (Index v = 0; v < mesh.num_vertices(); ++v) {
    seen_from[v] = v;
    for (const Corner at : corners.of(v)) {
      for (const Index w : mesh.cells.col(at.simplex())) {
        if (seen_from[w] == v) continue;
        seen_from[w] = v;
        const double length = (mesh.points.col(v) - mesh.points.col(w)).norm();
        edges.items.push_back({w, static_cast<float>(length)});
      }
    }
    edges.start.push_back(static_cast<Index>(edges.items.size()));
  }
  return edges;
}

float mean_length_of(const std::vector<EdgeTo>& edges) {
  double total = 0;
  for (const EdgeTo& edge : edges) total += edge.length;
  return static_cast<float>(total / static_cast<double>(edges.size()));
}

std::vector<Triangle> eikonal_facets(const DomainMesh<3>& mesh, const MeshTopology<3>& topology) {
  std::vector<Triangle> facets(topology.num_facets());
  parallel_for(topology.num_facets(), [&](Index f) {
    const auto corner = [&](int k) { return mesh.points.col(topology.facets(k, f)); };
    const Vector<3> first = corner(1) - corner(0);
    const Vector<3> second = corner(2) - corner(0);
    const double aa = first.squaredNorm(), bb = second.squaredNorm(), ab = first.dot(second);
    facets[f] = triangle((second - first).squaredNorm(), bb, aa,
                         std::sqrt(std::max(0.0, aa * bb - ab * ab)));
  });
  return facets;
}

// For sides of facets with both ends on reflex edges: the opposite corner, for each end.
VertexItems<Corner> bends_of_vertices(const MeshTopology<3>& topology,
                                      const std::vector<std::uint8_t>& on_reflex_edge) {
  const auto num_vertices = static_cast<Index>(on_reflex_edge.size());
  return items_by_vertex<Corner>(num_vertices, [&](const auto& visit) {
    for (Index f = 0; f < topology.num_facets(); ++f) {
      for (int k = 0; k < 3; ++k) {
        const Index first = topology.facets((k + 1) % 3, f);
        const Index second = topology.facets((k + 2) % 3, f);
        if (on_reflex_edge[first] == 0 || on_reflex_edge[second] == 0) continue;
        visit(first, Corner(f, k));
        visit(second, Corner(f, k));
      }
    }
  });
}

}  // namespace

template <int Dim>
EikonalMesh<Dim>::EikonalMesh(const DomainMesh<Dim>& mesh, const MeshTopology<Dim>& the_topology)
    : cells(mesh.num_cells()),
      look_back(mesh.num_cells()),
      corners(corners_of_vertices(mesh)),
      edges(edges_of_vertices(mesh, corners)),
      mean_length(mean_length_of(edges.items)),
      topology(the_topology) {
  parallel_for(mesh.num_cells(), [&](Index s) {
    const CellLengths<Dim> lengths(mesh, s);
    cells[s] = eikonal_cell(mesh, s, lengths);
    look_back[s] = look_back_of(lengths);
  });
  if constexpr (Dim == 3) {
    facets = eikonal_facets(mesh, topology);
    bends = bends_of_vertices(topology, on_reflex_edges(mesh, topology));
  }
}

template struct EikonalMesh<2>;
template struct EikonalMesh<3>;

}  // namespace flbc::distance
