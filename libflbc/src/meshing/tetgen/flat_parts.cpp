// SPDX-License-Identifier: BSD-3-Clause
#include "meshing/tetgen/flat_parts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <map>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include "base/messages.h"
#include "cage/facet_geometry.h"
#include "cage/point_in_cage.h"
#include "flbc/bounding_box.h"
#include "flbc/domain_mesh.h"
#include "flbc/errors.h"

namespace flbc {
namespace {

// Cells, vertices, and the cells at each vertex. Indices stay valid; removed cells keep theirs.
class CellComplex {
 public:
  using Corners = std::array<Index, 4>;
  using Simplex = std::vector<Index>;  //!< an edge or triangle of the mesh

  explicit CellComplex(const DomainMesh<3>& mesh)
      : cells_at_(static_cast<std::size_t>(mesh.num_vertices())) {
    for (Index v = 0; v < mesh.num_vertices(); ++v) points_.push_back(mesh.points.col(v));
    for (Index c = 0; c < mesh.num_cells(); ++c) {
      add_cell({mesh.cells(0, c), mesh.cells(1, c), mesh.cells(2, c), mesh.cells(3, c)});
    }
  }

  const Vector<3>& point(Index vertex) const { return points_[vertex]; }
  Index num_vertices() const { return static_cast<Index>(points_.size()); }
  Index num_cells() const { return static_cast<Index>(cells_.size()); }
  bool is_alive(Index cell) const { return is_alive_[cell]; }

  bool is_used(Index vertex) const {
    const std::vector<Index>& cells = cells_at_[vertex];
    return std::any_of(cells.begin(), cells.end(), [&](Index cell) { return is_alive(cell); });
  }

  Index add_vertex(const Vector<3>& point) {
    points_.push_back(point);
    cells_at_.emplace_back();
    return num_vertices() - 1;
  }

  // Divides every cell that contains the simplex at a vertex on the simplex.
  void split(const Simplex& simplex, Index vertex) {
    const std::vector<Index> candidates = cells_at_[simplex.front()];  // a copy, because it grows
                                                                       // below
    for (Index cell : candidates) {
      const Corners whole = cells_[cell];
      const bool has_simplex = std::all_of(simplex.begin(), simplex.end(), [&](Index corner) {
        return std::find(whole.begin(), whole.end(), corner) != whole.end();
      });
      if (!is_alive(cell) || !has_simplex) continue;
      is_alive_[cell] = false;
      for (Index replaced : simplex) {
        Corners part = whole;
        std::replace(part.begin(), part.end(), replaced, vertex);
        add_cell(part);
      }
    }
  }

  // The boundary triangles at a vertex, in a fixed order.
  std::vector<Simplex> boundary_faces_at(Index vertex) const {
    std::map<Simplex, int> num_cells_of;
    for (Index cell : cells_at_[vertex]) {
      if (!is_alive(cell)) continue;
      for (Index opposite : cells_[cell]) {
        if (opposite == vertex) continue;
        Simplex face;
        std::copy_if(cells_[cell].begin(), cells_[cell].end(), std::back_inserter(face),
                     [&](Index corner) { return corner != opposite; });
        std::sort(face.begin(), face.end());
        ++num_cells_of[face];
      }
    }
    std::vector<Simplex> boundary;
    for (const auto& [face, count] : num_cells_of) {
      if (count == 1) boundary.push_back(face);
    }
    return boundary;
  }

  // Vertices without a cell are kept.
  DomainMesh<3> to_mesh() const {
    DomainMesh<3> mesh;
    mesh.points.resize(3, num_vertices());
    for (Index v = 0; v < num_vertices(); ++v) mesh.points.col(v) = points_[v];
    mesh.cells.resize(4, std::count(is_alive_.begin(), is_alive_.end(), true));
    Index count = 0;
    for (Index cell = 0; cell < num_cells(); ++cell) {
      if (!is_alive(cell)) continue;
      for (int k = 0; k < 4; ++k) mesh.cells(k, count) = cells_[cell][k];
      ++count;
    }
    return mesh;
  }

 private:
  void add_cell(const Corners& corners) {
    for (Index vertex : corners) cells_at_[vertex].push_back(num_cells());
    cells_.push_back(corners);
    is_alive_.push_back(true);
  }

  std::vector<Vector<3>> points_;
  std::vector<Corners> cells_;
  std::vector<bool> is_alive_;
  std::vector<std::vector<Index>> cells_at_;  // per vertex, removed ones included
};

// A cell is flat if its volume is below this fraction of the cube of its longest edge. The worst
// other cells of TetGen are above 1e-6, and cells of four coplanar points are below 1e-14 by
// rounding. Also the relative tolerance for crossing edges and for points in triangles, which is
// above the TetGen tolerance for coplanar facets.
constexpr double kFlat = 1e-9;
constexpr double kOnTop = 1e-7;

using Edge = std::pair<Index, Index>;
using Segment = std::pair<Vector<3>, Vector<3>>;
using Simplex = CellComplex::Simplex;

bool is_flat(const DomainMesh<3>& mesh, Index cell) {
  double longest = 0;
  for (int a = 0; a < 4; ++a) {
    for (int b = 0; b < a; ++b) {
      const auto side = mesh.points.col(mesh.cells(a, cell)) - mesh.points.col(mesh.cells(b, cell));
      longest = std::max(longest, side.norm());
    }
  }
  return std::abs(signed_measure(mesh, cell)) <= kFlat * longest * longest * longest;
}

// \return the vertices of the cells removed
std::set<Index> remove_flat_cells(DomainMesh<3>& mesh) {
  std::set<Index> vertices;
  Index count = 0;
  for (Index cell = 0; cell < mesh.num_cells(); ++cell) {
    if (is_flat(mesh, cell)) {
      for (int k = 0; k < 4; ++k) vertices.insert(mesh.cells(k, cell));
    } else {
      mesh.cells.col(count++) = mesh.cells.col(cell);
    }
  }
  mesh.cells.conservativeResize(4, count);
  return vertices;
}

// The boundary faces between the vertices: the newly exposed faces, and possibly adjacent ones.
std::vector<Simplex> bare_faces(const DomainMesh<3>& mesh, const std::set<Index>& vertices) {
  const MeshTopology<3> topology = build_topology(mesh);
  std::vector<Simplex> faces;
  for (Index facet = 0; facet < topology.num_facets(); ++facet) {
    const auto corners = topology.facets.col(facet);
    const bool is_between = std::all_of(corners.begin(), corners.end(),
                                        [&](Index corner) { return vertices.count(corner) > 0; });
    if (is_between && topology.is_boundary(facet)) {
      faces.push_back({corners(0), corners(1), corners(2)});
    }
  }
  return faces;
}

[[noreturn]] void refuse_flat_cell(const Vector<3>& place) {
  throw InputError("TetGen left a cell without volume near " + format_point(place) +
                   "; points or facets are extremely close to each other there");
}

// Flat cells inside would leave a slit.
void refuse_slits(const Cage<3>& cage, const DomainMesh<3>& mesh,
                  const std::vector<Simplex>& faces) {
  const CageLocator<3> locator(cage, kOnTop * bounding_box_diagonal<3>(cage.points));
  for (const Simplex& face : faces) {
    Vector<3> centre = Vector<3>::Zero();
    for (Index corner : face) centre += mesh.points.col(corner) / 3;
    if (locator.locate(centre) != Containment::kOnCage) refuse_flat_cell(centre);
  }
}

// The corners of the face that span the simplex in whose interior the point lies; empty if it lies
// outside the face.
Simplex containing_simplex(const CellComplex& complex, const Simplex& face,
                           const Vector<3>& point) {
  const Vector<3>&a = complex.point(face[0]), &b = complex.point(face[1]),
        &c = complex.point(face[2]);
  const Vector<3> normal = (b - a).cross(c - a);
  const double doubled = normal.squaredNorm();
  if (std::abs((point - a).dot(normal)) > kOnTop * std::pow(doubled, 0.75)) return {};
  const double shares[3] = {(b - point).cross(c - point).dot(normal) / doubled,
                            (c - point).cross(a - point).dot(normal) / doubled,
                            (a - point).cross(b - point).dot(normal) / doubled};
  Simplex simplex;
  for (int k = 0; k < 3; ++k) {
    if (shares[k] < -kFlat) return {};
    if (shares[k] > kFlat) simplex.push_back(face[k]);
  }
  return simplex;
}

// A control point inside a flat part of the cage may have belonged to flat cells only.
// \param faces  candidate faces, kept up to date
void put_back(Index vertex, CellComplex& complex, std::vector<Simplex>& faces) {
  for (std::size_t f = 0; f < faces.size(); ++f) {
    const Simplex simplex = containing_simplex(complex, faces[f], complex.point(vertex));
    if (simplex.size() < 2) continue;
    complex.split(simplex, vertex);
    const auto has_simplex = [&](const Simplex& face) {
      return std::all_of(simplex.begin(), simplex.end(), [&](Index corner) {
        return std::find(face.begin(), face.end(), corner) != face.end();
      });
    };
    faces.erase(std::remove_if(faces.begin(), faces.end(), has_simplex), faces.end());
    for (const Simplex& part : complex.boundary_faces_at(vertex)) faces.push_back(part);
    return;
  }
}

Vector<3> unit_normal(const Cage<3>& cage, Index facet) {
  return facet_normal<3>(cage.points(Eigen::all, cage.facets.col(facet))).normalized();
}

// The edges of the cage between coplanar facets, with a margin.
std::vector<Segment> flat_edges(const Cage<3>& cage) {
  const double margin = 10 * kCoplanarAngle * std::acos(-1.0) / 180;
  std::map<Edge, Index> first_facet;
  std::vector<Segment> segments;
  for (Index facet = 0; facet < cage.facets.cols(); ++facet) {
    for (int k = 0; k < 3; ++k) {
      const Index a = cage.facets(k, facet), b = cage.facets((k + 1) % 3, facet);
      const auto [entry, is_new] = first_facet.emplace(std::minmax(a, b), facet);
      if (is_new) continue;
      const Vector<3> n = unit_normal(cage, facet), m = unit_normal(cage, entry->second);
      if (n.dot(m) > 0 && n.cross(m).norm() <= margin) {
        segments.emplace_back(cage.points.col(entry->first.first),
                              cage.points.col(entry->first.second));
      }
    }
  }
  return segments;
}

// The point of the first segment where the second crosses it, both in their interiors.
std::optional<Vector<3>> crossing(const Segment& first, const Segment& second) {
  const Vector<3> along_first = first.second - first.first;
  const Vector<3> along_second = second.second - second.first;
  const Vector<3> offset = second.first - first.first;
  const Vector<3> normal = along_first.cross(along_second);
  const double lengths = along_first.norm() * along_second.norm();
  if (normal.norm() <= kFlat * lengths) return std::nullopt;  // parallel
  const double s = offset.cross(along_second).dot(normal) / normal.squaredNorm();
  const double t = offset.cross(along_first).dot(normal) / normal.squaredNorm();
  if (std::min({s, 1 - s, t, 1 - t}) <= kFlat) return std::nullopt;
  if (std::abs(offset.dot(normal.normalized())) > kOnTop * along_first.norm()) return std::nullopt;
  return first.first + s * along_first;
}

std::optional<Vector<3>> crossing_with_any(const std::vector<Segment>& segments,
                                           const Segment& edge) {
  const Eigen::AlignedBox3d edge_box(edge.first.cwiseMin(edge.second),
                                     edge.first.cwiseMax(edge.second));
  for (const Segment& segment : segments) {
    const double reach = kOnTop * (segment.second - segment.first).norm();
    const Vector<3> margin = Vector<3>::Constant(reach);
    const Eigen::AlignedBox3d box(segment.first.cwiseMin(segment.second) - margin,
                                  segment.first.cwiseMax(segment.second) + margin);
    if (!box.intersects(edge_box)) continue;
    if (auto place = crossing(segment, edge)) return place;
  }
  return std::nullopt;
}

std::array<Edge, 3> edges_of(const Simplex& face) {
  return {std::minmax(face[0], face[1]), std::minmax(face[0], face[2]),
          std::minmax(face[1], face[2])};
}

// Two crossings in one face become connected by an edge between its parts, so mesh edges finally
// cover the segments.
void divide_along(const std::vector<Segment>& segments, const std::vector<Simplex>& faces,
                  CellComplex& complex) {
  std::set<Edge> unchecked;
  for (const Simplex& face : faces) {
    for (const Edge& edge : edges_of(face)) unchecked.insert(edge);
  }
  while (!unchecked.empty()) {
    const Edge edge = *unchecked.begin();
    unchecked.erase(unchecked.begin());
    const auto place =
        crossing_with_any(segments, {complex.point(edge.first), complex.point(edge.second)});
    if (!place) continue;
    const Index vertex = complex.add_vertex(*place);
    complex.split({edge.first, edge.second}, vertex);
    for (const Simplex& face : complex.boundary_faces_at(vertex)) {
      for (const Edge& part : edges_of(face)) {
        if (part.first == vertex || part.second == vertex) unchecked.insert(part);
      }
    }
  }
}

}  // namespace

bool has_coplanar_facets(const Cage<3>& cage) {
  return !flat_edges(cage).empty();
}

void peel_flat_cells(const Cage<3>& cage, Index num_input_points, DomainMesh<3>& mesh) {
  const std::set<Index> vertices = remove_flat_cells(mesh);
  if (vertices.empty()) return;
  std::vector<Simplex> faces = bare_faces(mesh, vertices);
  refuse_slits(cage, mesh, faces);

  CellComplex complex(mesh);
  for (Index vertex : vertices) {
    if (vertex < num_input_points && !complex.is_used(vertex)) put_back(vertex, complex, faces);
  }
  divide_along(flat_edges(cage), faces, complex);
  mesh = complex.to_mesh();
  for (Index cell = 0; cell < mesh.num_cells(); ++cell) {
    if (is_flat(mesh, cell)) refuse_flat_cell(mesh.points.col(mesh.cells(0, cell)));
  }
}

}  // namespace flbc
