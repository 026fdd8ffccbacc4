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
  std::vector<io::VertexField> fields;
  const auto mesh = io::read_domain<Dim>(path, fields);
  require_mesh(mesh);
  for (const auto& field : fields) {
    require(field.values.size() == mesh.num_vertices() && field.values.allFinite(),
            "fields have a finite value per vertex");
  }
}

// The fuzzed file is next to this one.
void read_mesh_beside(const std::string& path) {
  read_mesh<3>(path.substr(0, path.rfind('.')) + ".mesh");
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
std::string file_of(const DomainMesh<Dim>& mesh, const std::string& name,
                    const std::vector<io::VertexField>& fields = {}) {
  return written(name, [&](const std::string& path) { io::write_domain(path, mesh, fields); });
}

const char* const kMeditOfOthers =
    "MeshVersionFormatted 2\n# by hand\nDimension\n3\nVertices 4\n0 0 0 1\n1 0 0 2\n0 1 0 3\n0 0 1 "
    "4\n"
    "Triangles 1\n1 2 3 7\nHexahedra 0\nTetrahedra\n1\n1 2 3 4 9\nCorners 1\n1\nEnd\n";

const char* const kSolution =
    "MeshVersionFormatted 2\nDimension 3\n# field 0 weight of 3\nSolAtVertices\n4\n2 1 1\n1 0.5\n0 "
    "0\n"
    "2 1e-3\n4 4\nEnd\n";

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

const char* const kVtuOfOthers =
    "<?xml version='1.0'?><!-- a --><VTKFile type=\"UnstructuredGrid\"><UnstructuredGrid>"
    "<Piece NumberOfPoints=\"4\" NumberOfCells=\"2\"><PointData Scalars='a'>"
    "<DataArray Name='a&amp;&#x62;' type='Float32' format='ascii'>1 2 3 4</DataArray>"
    "<DataArray Name='v' NumberOfComponents='3'>1 2 3</DataArray></PointData>"
    "<Points><DataArray NumberOfComponents='3'>0 0 0 1 0 0 0 1 0 0 0 1</DataArray></Points><Cells>"
    "<DataArray Name='connectivity'>0 1 2 3 0 1 2</DataArray><DataArray Name='offsets'>4 7"
    "</DataArray><DataArray Name='types'>10 5</DataArray></Cells></Piece></UnstructuredGrid>"
    "</VTKFile>";

}  // namespace

std::vector<Reader> mesh_readers() {
  const auto mesh = two_tetrahedra();
  const auto plane = two_triangles();
  const std::vector<io::VertexField> fields{{"height", mesh.points.row(2)}};
  const std::vector<io::VertexField> widths{{"width", plane.points.row(0)}};
  return {{"obj_2d", "input.obj", read_mesh<2>, {file_of(plane, "a.obj")}},
          {"vtu_2d", "input.vtu", read_mesh<2>, {file_of(plane, "a.vtu", widths)}},
          {"vtu", "input.vtu", read_mesh<3>, {file_of(mesh, "a.vtu", fields), kVtuOfOthers}},
          {"medit", "input.mesh", read_mesh<3>, {file_of(mesh, "a.mesh"), kMeditOfOthers}},
          {"sol", "input.sol", read_mesh_beside, {kSolution}, {{"input.mesh", kMeditOfOthers}}},
          {"gmsh", "input.msh", read_mesh<3>, {file_of(mesh, "a.msh"), kGmsh4, kGmshOfOthers}}};
}

}  // namespace flbc::fuzz
