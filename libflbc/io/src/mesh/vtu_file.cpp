// SPDX-License-Identifier: BSD-3-Clause
// Writes the VTK XML format for unstructured grids, as text; viewers read it.
#include <ostream>

#include "base/instantiate.h"
#include "flbc/errors.h"
#include "flbc/io/files.h"
#include "mesh/mesh_formats.h"
#include "text/text_writer.h"

namespace flbc::io {
namespace {

constexpr int kVtkTriangle = 5;
constexpr int kVtkTetrahedron = 10;

void open_array(TextWriter& writer, const char* type, const std::string& name, int components) {
  writer << "<DataArray type=\"" << type << "\" Name=\"" << escaped(name)
         << "\" NumberOfComponents=\"" << components << "\" format=\"ascii\">\n";
}

void close_array(TextWriter& writer) {
  writer << "</DataArray>\n";
}

template <int Dim>
void write_points(TextWriter& writer, const DomainMesh<Dim>& mesh) {
  writer << "<Points>\n";
  open_array(writer, "Float64", "Points", 3);
  for (Index v = 0; v < mesh.num_vertices(); ++v) {
    write_point(writer, mesh, v);
    writer << "\n";
  }
  close_array(writer);
  writer << "</Points>\n";
}

template <int Dim>
void write_cells(TextWriter& writer, const DomainMesh<Dim>& mesh) {
  writer << "<Cells>\n";
  open_array(writer, "Int64", "connectivity", 1);
  for (Index s = 0; s < mesh.num_cells(); ++s) write_cell(writer, mesh, s, 0);
  close_array(writer);
  open_array(writer, "Int64", "offsets", 1);
  for (Index s = 0; s < mesh.num_cells(); ++s) {
    writer << (s + std::int64_t{1}) * (Dim + 1) << "\n";
  }
  close_array(writer);
  open_array(writer, "UInt8", "types", 1);
  for (Index s = 0; s < mesh.num_cells(); ++s) {
    writer << (Dim == 2 ? kVtkTriangle : kVtkTetrahedron) << "\n";
  }
  close_array(writer);
  writer << "</Cells>\n";
}

void write_fields(TextWriter& writer, const std::vector<VertexField>& fields) {
  writer << "<PointData>\n";
  for (const VertexField& field : fields) {
    open_array(writer, "Float64", field.name, 1);
    for (const double value : field.values) writer << value << "\n";
    close_array(writer);
  }
  writer << "</PointData>\n";
}

}  // namespace

template <int Dim>
DomainMesh<Dim> read_vtu(const std::string& path) {
  throw OptionError(path +
                    ": .vtu files are only written, for viewers such as ParaView; save the mesh "
                    "as .mesh (in 2D .obj) as well, or convert it, for example with meshio");
}

template <int Dim>
void write_vtu(const std::string& path, const DomainMesh<Dim>& mesh,
               const std::vector<VertexField>& fields) {
  write_file(path, [&](std::ostream& out) {
    TextWriter writer(out);
    writer << "<?xml version=\"1.0\"?>\n"
           << "<VTKFile type=\"UnstructuredGrid\" version=\"0.1\" byte_order=\"LittleEndian\">\n"
           << "<UnstructuredGrid>\n<Piece NumberOfPoints=\"" << mesh.num_vertices()
           << "\" NumberOfCells=\"" << mesh.num_cells() << "\">\n";
    write_points(writer, mesh);
    write_cells(writer, mesh);
    write_fields(writer, fields);
    writer << "</Piece>\n</UnstructuredGrid>\n</VTKFile>\n";
    writer.flush();
  });
}

FLBC_INSTANTIATE_FUNCTION(read_vtu)
FLBC_INSTANTIATE_FUNCTION(write_vtu)

}  // namespace flbc::io
