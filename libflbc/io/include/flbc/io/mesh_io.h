// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Domain mesh files in double precision.
#pragma once

#include <string>
#include <vector>

#include "flbc/domain_mesh.h"
#include "flbc/io/model.h"

namespace flbc::io {

//! A named scalar per vertex, for formats that carry fields.
struct VertexField {
  std::string name;        //!< as shown in viewers
  Eigen::VectorXd values;  //!< V
};

//! Reads a domain mesh; the format follows from the extension. 2D: .obj, .off (triangles in the
//! plane z = 0), .vtu. 3D: MEDIT .mesh (text), Gmsh .msh (2.2 and 4.1 text), .vtu (ascii).
//! Orientation is made positive and the mesh validated (normalize_and_validate).
//! \throws IoError; InputError naming file and line or element; OptionError for another extension
template <int Dim>
DomainMesh<Dim> read_domain(const std::string& path);

//! The same with fields: the scalar point data of .vtu, or the .sol file next to a MEDIT .mesh file
//! (names as written by write_domain(), or "solution K").
//! \param fields  output; empty for other formats and if there are none
template <int Dim>
DomainMesh<Dim> read_domain(const std::string& path, std::vector<VertexField>& fields);

//! The triangles of a 2D mesh, or the outward-oriented boundary of a 3D mesh.
//! \param mesh  positively oriented (normalize_and_validate)
//! \return all vertices in the same order; z = 0 in 2D
template <int Dim>
PolygonSoup to_polygons(const DomainMesh<Dim>& mesh);

//! Writes a domain mesh; the format follows from the extension. 2D: .obj, .off, .vtu. 3D: .mesh,
//! .msh (2.2), .vtu. Coordinates have 17 digits. Fields are written to .vtu, or for .mesh to a .sol
//! file next to it. Without fields, an existing .sol file is unchanged.
//! \throws IoError; InputError if a number is not finite, a field does not have one value per
//! vertex, or its name is empty, not unique, or contains control characters; OptionError for
//! another extension, or for fields that would be lost
template <int Dim>
void write_domain(const std::string& path, const DomainMesh<Dim>& mesh,
                  const std::vector<VertexField>& fields = {});

}  // namespace flbc::io
