// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Domain mesh files with double precision.
#pragma once

#include <string>
#include <vector>

#include "flbc/domain_mesh.h"

namespace flbc::io {

//! A named scalar per vertex, for formats that carry fields.
struct VertexField {
  std::string name;        //!< as viewers show it
  Eigen::VectorXd values;  //!< V
};

//! Reads by extension. 2D: .obj, .off (triangles in the plane z = 0). 3D: MEDIT .mesh (text),
//! TetGen .node / .ele (either name; first index 0 or 1), Gmsh .msh (2.2 and 4.1 text).
//! Orientation is made positive and the mesh validated (normalize_and_validate).
//! \throws IoError; InputError naming file and line or element; OptionError for another extension
template <int Dim>
DomainMesh<Dim> read_domain(const std::string& path);

//! Writes by extension. 2D: .obj, .off, .vtu. 3D: .mesh, .node (with .ele beside it) or .ele, .msh
//! (2.2), .vtu. Coordinates have 17 digits. Fields are written by .vtu only.
//! \throws IoError; InputError if a number is not finite or a field has not a value per vertex;
//! OptionError for another extension
template <int Dim>
void write_domain(const std::string& path, const DomainMesh<Dim>& mesh,
                  const std::vector<VertexField>& fields = {});

}  // namespace flbc::io
