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

void TetMesh::assign_valid(const DomainMesh<3>& mesh) {
  static_cast<TetConnectivity&>(*this) = TetConnectivity(mesh);
  points_.clear();
  for (const auto& point : mesh.points.colwise()) {
    points_.emplace_back(point[0], point[1], point[2]);
  }
  container<VertexHandle>().resize(n_vertices());
  container<EdgeHandle>().resize(n_edges());
  container<FaceHandle>().resize(n_faces());
  container<CellHandle>().resize(n_cells());
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

}  // namespace flbc::openmesh
