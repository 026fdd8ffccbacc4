// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/openmesh/tet_mesh_io.h"

namespace flbc::openmesh {

TetMesh read_tet_mesh(const std::string& path) {
  TetMesh mesh;
  mesh.assign_valid(io::read_domain<3>(path));
  return mesh;
}

TetMesh read_tet_mesh(const std::string& path, std::vector<io::VertexField>& fields) {
  TetMesh mesh;
  mesh.assign_valid(io::read_domain<3>(path, fields));
  return mesh;
}

void write_tet_mesh(const std::string& path, const TetMesh& mesh,
                    const std::vector<io::VertexField>& fields, io::GmshVersion gmsh_version) {
  io::write_domain(path, mesh.domain(), fields, gmsh_version);
}

}  // namespace flbc::openmesh
