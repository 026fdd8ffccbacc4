// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! The domain mesh file formats, a file each. Contracts as in flbc/io/mesh_io.h, but readers leave
//! orientation and validation to their caller.
#pragma once

#include <cstdint>
#include <iosfwd>
#include <string>
#include <vector>

#include "flbc/domain_mesh.h"
#include "flbc/io/mesh_io.h"
#include "text/text_writer.h"

namespace flbc::io {

DomainMesh<3> read_medit(const std::string& path);

//! The scalars per vertex in a .sol file of MEDIT's.
std::vector<VertexField> read_medit_solution(const std::string& path, Index num_vertices);

DomainMesh<3> read_gmsh(const std::string& path);

//! \param path the .node or the .ele file; the other one lies beside it
DomainMesh<3> read_tetgen(const std::string& path);

//! \param fields  receives the scalars per vertex; null passes them over
template <int Dim>
DomainMesh<Dim> read_vtu(const std::string& path, std::vector<VertexField>* fields);

void write_medit(std::ostream& out, const DomainMesh<3>& mesh);
void write_medit_solution(std::ostream& out, const std::vector<VertexField>& fields);
void write_gmsh(std::ostream& out, const DomainMesh<3>& mesh, GmshVersion version);
void write_tetgen(const std::string& path, const DomainMesh<3>& mesh);

template <int Dim>
void write_vtu(std::ostream& out, const DomainMesh<Dim>& mesh,
               const std::vector<VertexField>& fields);

//! Writes `first + index` of each vertex of a cell, each after a blank, and a line break.
template <int Dim>
void write_cell(TextWriter& writer, const DomainMesh<Dim>& mesh, Index cell, std::int64_t first) {
  for (int k = 0; k <= Dim; ++k) writer << " " << mesh.cells(k, cell) + first;
  writer << "\n";
}

//! Writes the coordinates of a vertex with blanks between; in 2D, z = 0 completes them.
template <int Dim>
void write_point(TextWriter& writer, const DomainMesh<Dim>& mesh, Index vertex) {
  const auto p = mesh.points.col(vertex);
  writer << p[0] << " " << p[1] << " " << (Dim == 3 ? p[Dim - 1] : 0.0);
}

}  // namespace flbc::io
