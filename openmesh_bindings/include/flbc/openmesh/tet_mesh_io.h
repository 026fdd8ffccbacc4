// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Tetrahedral mesh files.
#pragma once

#include <string>
#include <vector>

#include "flbc/io/mesh_io.h"
#include "flbc/openmesh/tet_mesh.h"

namespace flbc::openmesh {

//! Reads MEDIT .mesh, TetGen .node / .ele, Gmsh .msh (2.2 and 4.1) or .vtu, all as text, exactly
//! (io::read_domain). Cells are turned to positive orientation.
//! \throws IoError; InputError naming file and line or element; OptionError for another extension
TetMesh read_tet_mesh(const std::string& path);

//! The same with the numbers per vertex that come along in .vtu, or in a .sol file beside .mesh.
//! \param fields  replaced
TetMesh read_tet_mesh(const std::string& path, std::vector<io::VertexField>& fields);

//! Writes the same formats (io::write_domain) without properties. Numbers per vertex can be stored
//! as fields in .vtu and next to .mesh; store all weights in .npy (io::write_weights).
//! \throws IoError; InputError if a number is not finite or a field has not a value per vertex;
//! OptionError for another extension, or for fields that would be lost
void write_tet_mesh(const std::string& path, const TetMesh& mesh,
                    const std::vector<io::VertexField>& fields = {},
                    io::GmshVersion gmsh_version = io::GmshVersion::k22);

}  // namespace flbc::openmesh
