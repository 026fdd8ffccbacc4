// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/openmesh/tet_mesh.h"

#include <utility>

namespace flbc::openmesh {

TetMesh TetMesh::from(const DomainMesh<3>& mesh) {
  TetMesh result;
  result.assign(mesh);
  return result;
}

void TetMesh::assign(const DomainMesh<3>& mesh) {
  DomainMesh<3> valid = mesh;
  normalize_and_validate(valid);
  assign_valid(valid);
}

void TetMesh::assign(const PointList<3>& points, const CellList<3>& cells) {
  assign(DomainMesh<3>{points, cells});
}

void TetMesh::assign_valid(const DomainMesh<3>& mesh) {
  const auto num_vertices = static_cast<std::size_t>(mesh.num_vertices());
  const auto num_cells = static_cast<std::size_t>(mesh.num_cells());
  TetMesh built;
  // A ball of tetrahedra has about twice as many faces as cells and, by Euler's formula, one edge
  // per vertex more than cells.
  built.reserve(num_vertices, num_cells + num_vertices + num_cells / 16,
                2 * num_cells + num_cells / 8, num_cells);
  for (const auto& point : mesh.points.colwise()) {
    built.append_vertex();
    built.points_.emplace_back(point[0], point[1], point[2]);
  }
  for (const auto& cell : mesh.cells.colwise()) {
    built.append_cell({cell[0], cell[1], cell[2], cell[3]});
  }
  built.forget_tables();

  static_cast<TetConnectivity&>(*this) = static_cast<TetConnectivity&&>(built);
  points_ = std::move(built.points_);
  resize_properties();
}

DomainMesh<3> TetMesh::domain() const {
  DomainMesh<3> result;
  result.points.resize(3, static_cast<Eigen::Index>(n_vertices()));
  for (const auto vertex : vertices()) {
    const Point& p = point(vertex);
    result.points.col(vertex.idx()) << p[0], p[1], p[2];
  }
  result.cells.resize(4, static_cast<Eigen::Index>(n_cells()));
  for (const auto cell : cells()) {
    const auto corners = cv_range(cell);
    for (int k = 0; k < 4; ++k) result.cells(k, cell.idx()) = corners[k].idx();
  }
  return result;
}

void TetMesh::clear() {
  static_cast<TetConnectivity&>(*this) = TetMesh();
  points_.clear();
  resize_properties();
}

void TetMesh::reserve(std::size_t vertices, std::size_t edges, std::size_t faces,
                      std::size_t cells) {
  TetConnectivity::reserve(vertices, edges, faces, cells);
  points_.reserve(vertices);
  properties_.of<VertexHandle>().reserve(vertices);
  properties_.of<EdgeHandle>().reserve(edges);
  properties_.of<FaceHandle>().reserve(faces);
  properties_.of<CellHandle>().reserve(cells);
}

TetMesh::VertexHandle TetMesh::add_vertex(const Point& point) {
  points_.push_back(point);
  const VertexHandle vertex = append_vertex();
  properties_.grow<VertexHandle>(n_vertices());
  return vertex;
}

CellHandle TetMesh::add_cell(VertexHandle a, VertexHandle b, VertexHandle c, VertexHandle d) {
  const CellHandle cell = append_cell({a.idx(), b.idx(), c.idx(), d.idx()});
  properties_.grow<EdgeHandle>(n_edges());
  properties_.grow<FaceHandle>(n_faces());
  properties_.grow<CellHandle>(n_cells());
  return cell;
}

void TetMesh::resize_properties() {
  properties_.of<VertexHandle>().resize(n_vertices());
  properties_.of<EdgeHandle>().resize(n_edges());
  properties_.of<FaceHandle>().resize(n_faces());
  properties_.of<CellHandle>().resize(n_cells());
}

void TetMesh::swap(TetMesh& other) noexcept {
  std::swap(static_cast<TetConnectivity&>(*this), static_cast<TetConnectivity&>(other));
  points_.swap(other.points_);
  properties_.swap(other.properties_);
}

}  // namespace flbc::openmesh
