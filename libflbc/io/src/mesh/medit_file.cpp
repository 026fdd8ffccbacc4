// SPDX-License-Identifier: BSD-3-Clause
// MEDIT .mesh: sections that start with a keyword and a number of elements; each element ends with
// a reference number. Vertices are numbered from 1.
#include <ostream>

#include "flbc/io/files.h"
#include "mesh/mesh_formats.h"
#include "text/text_reader.h"

namespace flbc::io {
namespace {

constexpr std::string_view kOtherCells[] = {"Hexahedra", "Prisms", "Pyramids", "TetrahedraP2"};

// The number of elements of a section may be on the line of the keyword or the next one.
Index read_count(TextReader& reader, const char* things, std::size_t bytes_each) {
  reader.next_word_on_any_line();
  return reader.count(things, bytes_each);
}

void read_vertices(TextReader& reader, DomainMesh<3>& mesh) {
  const Index count = read_count(reader, "vertices", 8);
  mesh.points.resize(3, count);
  for (Index v = 0; v < count; ++v) {
    reader.next_word_of("vertices", v, count);
    mesh.points.col(v) = reader.point();
    reader.number();
  }
}

void read_tetrahedra(TextReader& reader, DomainMesh<3>& mesh) {
  const Index count = read_count(reader, "tetrahedra", 10);
  mesh.cells.resize(4, count);
  for (Index s = 0; s < count; ++s) {
    reader.next_word_of("tetrahedra", s, count);
    for (Index& vertex : mesh.cells.col(s)) {
      vertex = reader.index("vertices", 1, mesh.num_vertices());
    }
    reader.integer();
  }
}

bool is_keyword(std::string_view word) {
  return (word[0] >= 'A' && word[0] <= 'Z') || (word[0] >= 'a' && word[0] <= 'z');
}

// Skips other sections (edges, corners, normals, ...): numbers up to the next keyword.
void skip_section(TextReader& reader) {
  while (reader.next_word_on_any_line() && !is_keyword(reader.peek())) reader.word();
}

// \param read  reads the section of a keyword, or returns false to skip it
template <class Read>
void for_sections(TextReader& reader, const Read& read) {
  const std::string_view first = reader.next_line() ? reader.word() : "";
  if (first == "MFEM")
    reader.fail("not a MEDIT file, but one of MFEM; save it there by PrintVTU()");
  if (first != "MeshVersionFormatted") {
    reader.fail("not a MEDIT text file: the first word must be MeshVersionFormatted");
  }
  reader.word_on_any_line("the version");
  while (reader.next_word_on_any_line()) {
    const std::string_view keyword = reader.word();
    if (!is_keyword(keyword)) reader.fail_expected("a keyword", keyword);
    if (keyword == "End") return;
    if (keyword == "Dimension") {
      reader.next_word_on_any_line();
      const std::int64_t dimension = reader.integer();
      if (dimension != 3) reader.fail("the dimension is " + std::to_string(dimension) + ", not 3");
    } else if (!read(keyword)) {
      skip_section(reader);
    }
  }
}

}  // namespace

DomainMesh<3> read_medit(const std::string& path) {
  TextReader reader(path, read_file(path), {'#', false});
  DomainMesh<3> mesh;
  bool has_vertices = false;
  bool has_cells = false;
  for_sections(reader, [&](std::string_view keyword) {
    if (keyword == "Vertices") {
      if (has_vertices) reader.fail("a second section Vertices");
      read_vertices(reader, mesh);
      return has_vertices = true;
    }
    if (keyword == "Tetrahedra") {
      if (!has_vertices) reader.fail("the section Tetrahedra comes before Vertices");
      if (has_cells) reader.fail("a second section Tetrahedra");
      read_tetrahedra(reader, mesh);
      return has_cells = true;
    }
    for (const std::string_view other : kOtherCells) {
      if (keyword == other && reader.next_word_on_any_line() && reader.peek() != "0") {
        reader.fail("the cells include " + std::string(other) + "; only tetrahedra are supported");
      }
    }
    return false;
  });
  if (!has_vertices) reader.fail("the file has no section Vertices");
  if (!has_cells) reader.fail("the file has no section Tetrahedra");
  return mesh;
}

void write_medit(const std::string& path, const DomainMesh<3>& mesh,
                 const std::vector<VertexField>&) {
  write_file(path, [&](std::ostream& out) {
    TextWriter writer(out);
    writer << "MeshVersionFormatted 2\nDimension 3\n";
    writer << "Vertices\n" << mesh.num_vertices() << "\n";
    for (Index v = 0; v < mesh.num_vertices(); ++v) {
      write_point(writer, mesh, v);
      writer << " 0\n";
    }
    writer << "Tetrahedra\n" << mesh.num_cells() << "\n";
    for (Index s = 0; s < mesh.num_cells(); ++s) {
      for (int k = 0; k < 4; ++k) writer << mesh.cells(k, s) + std::int64_t{1} << " ";
      writer << "1\n";
    }
    writer << "End\n";
    writer.flush();
  });
}

}  // namespace flbc::io
