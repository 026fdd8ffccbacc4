// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Domain mesh files with double precision.
#pragma once

#include <string>
#include <vector>

#include "flbc/domain_mesh.h"
#include "flbc/io/model.h"

namespace flbc::io {

//! A named scalar per vertex, for formats that carry fields.
struct VertexField {
  std::string name;        //!< as viewers show it
  Eigen::VectorXd values;  //!< V
};

//! The two versions of Gmsh's format that are in use.
enum class GmshVersion { k22, k41 };

//! Reads by extension. 2D: .obj, .off (triangles in the plane z = 0), .vtu. 3D: MEDIT .mesh (text),
//! TetGen .node / .ele (either name; first index 0 or 1), Gmsh .msh (2.2 and 4.1 text), .vtu
//! (ascii). Orientation is made positive and the mesh validated (normalize_and_validate).
//! \throws IoError; InputError naming file and line or element; OptionError for another extension
template <int Dim>
DomainMesh<Dim> read_domain(const std::string& path);

//! The same with the fields that come along: the scalar point data of .vtu, or what is in the .sol
//! file beside MEDIT's .mesh (names as write_domain() puts them there, or "solution K").
//! \param fields  replaced; empty for other formats and where there are none
template <int Dim>
DomainMesh<Dim> read_domain(const std::string& path, std::vector<VertexField>& fields);

//! The triangles of a 2D mesh, the boundary of a 3D one seen from outside.
//! \param mesh  positively oriented (normalize_and_validate)
//! \return all vertices with their numbers; z = 0 in 2D
template <int Dim>
PolygonSoup to_polygons(const DomainMesh<Dim>& mesh);

//! Writes by extension. 2D: .obj, .off, .vtu. 3D: .mesh, .node (with .ele beside it) or .ele, .msh,
//! .vtu. Coordinates have 17 digits. Fields go into .vtu, and beside .mesh into a .sol file; where
//! there are no fields an old .sol file is left alone.
//! \throws IoError; InputError if a number is not finite, a field has not a value per vertex, or
//! its name is empty, not unique or has control characters; OptionError for another extension, or
//! for fields that would be lost
template <int Dim>
void write_domain(const std::string& path, const DomainMesh<Dim>& mesh,
                  const std::vector<VertexField>& fields = {},
                  GmshVersion gmsh_version = GmshVersion::k22);

}  // namespace flbc::io
