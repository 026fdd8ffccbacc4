// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/domain_mesh.h"

#include "base/instantiate.h"
#include "base/messages.h"
#include "base/shape_checks.h"
#include "base/union_find.h"
#include "flbc/errors.h"

namespace flbc {
namespace {

// Parts are numbered in the order of their first vertices.
template <int Dim>
std::vector<Index> part_of_vertices(const DomainMesh<Dim>& mesh, Index& count) {
  check_indices(mesh.cells, mesh.num_vertices(), kMeshNames);
  UnionFind sets(mesh.num_vertices());
  for (Index s = 0; s < mesh.num_cells(); ++s) {
    for (int k = 1; k <= Dim; ++k) sets.unite(mesh.cells(0, s), mesh.cells(k, s));
  }
  count = 0;
  std::vector<Index> part(mesh.num_vertices());
  for (Index v = 0; v < mesh.num_vertices(); ++v) {
    const Index root = sets.find(v);  // the set's smallest vertex
    part[v] = root == v ? count++ : part[root];
  }
  return part;
}

}  // namespace

template <int Dim>
Index count_parts(const DomainMesh<Dim>& mesh) {
  Index count = 0;
  part_of_vertices(mesh, count);
  return count;
}

template <int Dim>
std::vector<MeshPart<Dim>> mesh_parts(const DomainMesh<Dim>& mesh) {
  Index count = 0;
  const auto part_of_vertex = part_of_vertices(mesh, count);
  std::vector<MeshPart<Dim>> parts(count);
  std::vector<Index> number(mesh.num_vertices());  // in the part
  for (Index v = 0; v < mesh.num_vertices(); ++v) {
    auto& vertices = parts[part_of_vertex[v]].vertices;
    number[v] = static_cast<Index>(vertices.size());
    vertices.push_back(v);
  }
  std::vector<Index> num_cells(count, 0);
  for (const Index first : mesh.cells.row(0)) ++num_cells[part_of_vertex[first]];
  for (Index p = 0; p < count; ++p) {
    parts[p].mesh.points = mesh.points(Eigen::all, parts[p].vertices);
    parts[p].mesh.cells.resize(Dim + 1, num_cells[p]);
    num_cells[p] = 0;
  }
  for (const auto& cell : mesh.cells.colwise()) {
    const Index p = part_of_vertex[cell[0]];
    for (int k = 0; k <= Dim; ++k) parts[p].mesh.cells(k, num_cells[p]) = number[cell[k]];
    ++num_cells[p];
  }
  return parts;
}

template <int Dim>
DomainMesh<Dim> join_parts(const std::vector<MeshPart<Dim>>& parts) {
  Index num_vertices = 0, num_cells = 0;
  for (const auto& part : parts) {
    num_vertices += part.mesh.num_vertices();
    num_cells += part.mesh.num_cells();
  }
  DomainMesh<Dim> whole{PointList<Dim>(Dim, num_vertices), CellList<Dim>(Dim + 1, num_cells)};
  Index next = 0;
  for (const auto& [mesh, vertices] : parts) {
    if (static_cast<Eigen::Index>(vertices.size()) != mesh.points.cols()) {
      throw InputError("a part of the mesh has " + std::to_string(mesh.points.cols()) +
                       " points, but names " + std::to_string(vertices.size()) + " vertices");
    }
    check_indices(mesh.cells, mesh.num_vertices(), kMeshNames);
    check_indices(Eigen::Map<const Eigen::Matrix<Index, 1, Eigen::Dynamic>>(
                      vertices.data(), 1, static_cast<Eigen::Index>(vertices.size())),
                  num_vertices, kMeshNames);
    whole.points(Eigen::all, vertices) = mesh.points;
    for (const auto& cell : mesh.cells.colwise()) {
      for (int k = 0; k <= Dim; ++k) whole.cells(k, next) = vertices[cell[k]];
      ++next;
    }
  }
  return whole;
}

template <int Dim>
void require_connected(const DomainMesh<Dim>& mesh) {
  Index count = 0;
  const auto part = part_of_vertices(mesh, count);
  if (count <= 1) return;
  Index other = 0;
  while (part[other] == 0) ++other;
  throw InputError("the domain is not connected: it has " + std::to_string(count) +
                   " parts, one with " + format_point(mesh.points.col(0)) + ", one with " +
                   format_point(mesh.points.col(other)) + "; give each a cage of its own");
}

FLBC_INSTANTIATE_FUNCTION(count_parts)
FLBC_INSTANTIATE_FUNCTION(mesh_parts)
FLBC_INSTANTIATE_FUNCTION(join_parts)
FLBC_INSTANTIATE_FUNCTION(require_connected)

}  // namespace flbc
