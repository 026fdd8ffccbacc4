// SPDX-License-Identifier: BSD-3-Clause
// Meshes of the interior.
#include <string>

#include "flbc/domain_mesh.h"
#include "flbc/io/mesh_io.h"
#include "fuzz/reader.h"

namespace flbc::fuzz {
namespace {

template <int Dim>
void require_mesh(const DomainMesh<Dim>& mesh) {
  require_indices_in_range(mesh);
  require(mesh.num_cells() > 0, "there are cells");
  for (Index s = 0; s < mesh.num_cells(); ++s) {
    require(signed_measure(mesh, s) > 0, "cells are positively oriented");
  }
}

template <int Dim>
void read_mesh(const std::string& path) {
  require_mesh(io::read_domain<Dim>(path));
}

DomainMesh<3> two_tetrahedra() {
  DomainMesh<3> mesh{PointList<3>{{0, 1, 0, 0, 1}, {0, 0, 1, 0, 1}, {0, 0, 0, 1, 1.0 / 3}},
                     CellList<3>{{0, 1}, {1, 3}, {2, 2}, {3, 4}}};
  normalize_and_validate(mesh);
  return mesh;
}

DomainMesh<2> two_triangles() {
  return {PointList<2>{{0, 1, 1, 0}, {0, 0, 1.0 / 3, 1}}, CellList<2>{{0, 0}, {1, 2}, {2, 3}}};
}

template <int Dim>
std::string file_of(const DomainMesh<Dim>& mesh, const std::string& name) {
  return written(name, [&](const std::string& path) { io::write_domain(path, mesh); });
}

const char* const kMeditOfOthers =
    "MeshVersionFormatted 2\n# by hand\nDimension\n3\nVertices 4\n0 0 0 1\n1 0 0 2\n0 1 0 3\n0 0 1 "
    "4\n"
    "Triangles 1\n1 2 3 7\nHexahedra 0\nTetrahedra\n1\n1 2 3 4 9\nCorners 1\n1\nEnd\n";

const char* const kGmshOfOthers =
    "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n1\n3 1 "
    "\"a\"\n$EndPhysicalNames\n$Nodes\n"
    "4\n10 0 0 0\n11 1 0 0\n12 0 1 0\n13 0 0 1\n$EndNodes\n$Elements\n2\n1 2 2 1 1 10 11 12\n"
    "2 4 2 1 1 10 11 12 13\n$EndElements\n";

// Version 4.1, with two blocks of nodes.
const char* const kGmsh4 =
    "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Entities\n0 0 0 1\n1 0 0 0 1 1 1 0 0\n$EndEntities\n"
    "$Nodes\n2 4 1 4\n3 1 0 3\n1\n2\n4\n0 0 0\n1 0 0\n0 0 1\n3 1 0 1\n3\n0 1 0\n$EndNodes\n"
    "$Elements\n1 1 1 1\n3 1 4 1\n1 1 2 3 4\n$EndElements\n";

}  // namespace

std::vector<Reader> mesh_readers() {
  const auto mesh = two_tetrahedra();
  const auto plane = two_triangles();
  return {{"obj_2d", "input.obj", read_mesh<2>, {file_of(plane, "a.obj")}},
          {"medit", "input.mesh", read_mesh<3>, {file_of(mesh, "a.mesh"), kMeditOfOthers}},
          {"gmsh", "input.msh", read_mesh<3>, {file_of(mesh, "a.msh"), kGmsh4, kGmshOfOthers}}};
}

}  // namespace flbc::fuzz
