// SPDX-License-Identifier: BSD-3-Clause
// The file pair of TetGen: .node has "COUNT 3 ATTRIBUTES MARKERS", then "NUMBER X Y Z ..."; .ele
// has "COUNT 4 ATTRIBUTES", then "NUMBER A B C D ...". All numbers start at 0 or all at 1.
#include <filesystem>
#include <ostream>

#include "flbc/io/files.h"
#include "mesh/mesh_formats.h"
#include "text/text_reader.h"

namespace flbc::io {
namespace {

std::string with_extension(const std::string& path, const char* extension) {
  if (extension_of(path) == extension) return path;
  return std::filesystem::path(path).replace_extension(extension).string();
}

void read_number(TextReader& reader, const char* thing, std::int64_t expected) {
  const std::int64_t found = reader.integer();
  if (found == expected) return;
  reader.fail("expected " + std::string(thing) + " " + std::to_string(expected) + ", found " +
              std::to_string(found));
}

// \return the number of the first node, 0 or 1
std::int64_t read_nodes(const std::string& path, DomainMesh<3>& mesh) {
  TextReader reader(path, read_file(path), {'#', false});
  if (!reader.next_line()) reader.fail("the file ends before the number of nodes");
  const Index count = reader.count("nodes", 8);
  const std::int64_t dimension = reader.integer();
  if (dimension != 3) {
    reader.fail("the nodes have " + std::to_string(dimension) + " coordinates, not 3");
  }
  std::int64_t first = 0;
  mesh.points.resize(3, count);
  for (Index v = 0; v < count; ++v) {
    reader.next_line_of("nodes", v, count);
    if (v == 0 && reader.peek() == "1") first = 1;
    read_number(reader, "node", first + v);
    mesh.points.col(v) = reader.point();
  }
  if (reader.next_line())
    reader.fail_expected("the end of the file after the last node", reader.word());
  return first;
}

void read_elements(const std::string& path, std::int64_t first, DomainMesh<3>& mesh) {
  TextReader reader(path, read_file(path), {'#', false});
  if (!reader.next_line()) reader.fail("the file ends before the number of tetrahedra");
  const Index count = reader.count("tetrahedra", 10);
  const std::int64_t corners = reader.integer();
  if (corners != 4) {
    reader.fail("the tetrahedra have " + std::to_string(corners) + " nodes; only 4 are supported");
  }
  mesh.cells.resize(4, count);
  for (Index s = 0; s < count; ++s) {
    reader.next_line_of("tetrahedra", s, count);
    read_number(reader, "tetrahedron", first + s);
    for (Index& vertex : mesh.cells.col(s)) {
      vertex = reader.index("nodes", first, mesh.num_vertices());
    }
  }
  if (reader.next_line()) {
    reader.fail_expected("the end of the file after the last tetrahedron", reader.word());
  }
}

void write_nodes(std::ostream& out, const DomainMesh<3>& mesh) {
  TextWriter writer(out);
  writer << mesh.num_vertices() << " 3 0 0\n";
  for (Index v = 0; v < mesh.num_vertices(); ++v) {
    writer << v << " ";
    write_point(writer, mesh, v);
    writer << "\n";
  }
  writer.flush();
}

void write_elements(std::ostream& out, const DomainMesh<3>& mesh) {
  TextWriter writer(out);
  writer << mesh.num_cells() << " 4 0\n";
  for (Index s = 0; s < mesh.num_cells(); ++s) {
    writer << s;
    write_cell(writer, mesh, s, 0);
  }
  writer.flush();
}

}  // namespace

DomainMesh<3> read_tetgen(const std::string& path, std::vector<VertexField>*) {
  DomainMesh<3> mesh;
  const std::int64_t first = read_nodes(with_extension(path, "node"), mesh);
  read_elements(with_extension(path, "ele"), first, mesh);
  return mesh;
}

void write_tetgen(const std::string& path, const DomainMesh<3>& mesh,
                  const std::vector<VertexField>&) {
  // The .ele file is renamed only after the nodes are written, so a failure leaves neither file.
  write_file(with_extension(path, "node"), [&](std::ostream& nodes) {
    write_nodes(nodes, mesh);
    nodes.flush();
    if (!nodes) return;  // write_file() reports it
    write_file(with_extension(path, "ele"),
               [&](std::ostream& elements) { write_elements(elements, mesh); });
  });
}

}  // namespace flbc::io
