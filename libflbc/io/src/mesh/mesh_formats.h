// SPDX-License-Identifier: BSD-3-Clause
// The domain mesh file formats, one source file each. Contracts as in flbc/io/mesh_io.h, but
// readers leave orientation and validation to their caller.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "flbc/domain_mesh.h"
#include "flbc/io/mesh_io.h"
#include "text/text_writer.h"

namespace flbc::io {

//! \param fields  output: scalars per vertex if the format supports them; null: skip them
DomainMesh<2> read_triangles(const std::string& path, std::vector<VertexField>* fields);
DomainMesh<3> read_medit(const std::string& path, std::vector<VertexField>* fields);
DomainMesh<3> read_gmsh(const std::string& path, std::vector<VertexField>* fields);
template <int Dim>
DomainMesh<Dim> read_vtu(const std::string& path, std::vector<VertexField>* fields);

//! \param fields  empty if the format has none
void write_triangles(const std::string& path, const DomainMesh<2>& mesh,
                     const std::vector<VertexField>& fields);
void write_medit(const std::string& path, const DomainMesh<3>& mesh,
                 const std::vector<VertexField>& fields);
void write_gmsh(const std::string& path, const DomainMesh<3>& mesh,
                const std::vector<VertexField>& fields);
template <int Dim>
void write_vtu(const std::string& path, const DomainMesh<Dim>& mesh,
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
