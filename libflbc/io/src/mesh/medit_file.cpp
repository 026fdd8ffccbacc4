// SPDX-License-Identifier: BSD-3-Clause
// MEDIT .mesh: sections that start with a keyword and a number of elements; each element ends with
// a reference number. Vertices are numbered from 1. Values per vertex are in a separate .sol file
// of the same form.
#include <algorithm>
#include <filesystem>
#include <optional>

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

// The format has no names, so they are written as comments, "# field K NAME".
constexpr const char* kNameComment = "# field ";

std::string name_of_field(const std::string& content, Index field) {
  const std::string start = kNameComment + std::to_string(field) + " ";
  std::size_t begin = content.compare(0, start.size(), start) == 0 ? 0 : content.find("\n" + start);
  if (begin == std::string::npos) return "solution " + std::to_string(field);
  begin = content.find(start, begin) + start.size();
  std::string name =
      content.substr(begin, std::min(content.find('\n', begin), content.size()) - begin);
  if (!name.empty() && name.back() == '\r') name.pop_back();
  return name;
}

std::vector<VertexField> read_solution(TextReader& reader, Index num_vertices) {
  const Index count = read_count(reader, "vertices", 0);
  if (count != num_vertices) {
    reader.fail("there are values for " + std::to_string(count) + " vertices, but the mesh has " +
                std::to_string(num_vertices));
  }
  const Index num_fields = read_count(reader, "fields", 2 + 2 * static_cast<std::size_t>(count));
  for (Index k = 0; k < num_fields; ++k) {
    reader.next_word_of("types of fields", k, num_fields);
    if (reader.integer() != 1) {
      reader.fail("field " + std::to_string(k) + " has vectors or tensors; only scalars (type 1) " +
                  "are supported");
    }
  }
  std::vector<VertexField> fields(static_cast<std::size_t>(num_fields));
  for (auto& field : fields) field.values.resize(count);
  for (Index v = 0; v < count; ++v) {
    for (auto& field : fields) {
      reader.next_word_of("vertex values", v, count);
      field.values[v] = reader.number();
    }
  }
  return fields;
}

DomainMesh<3> read_medit_mesh(const std::string& path) {
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

std::vector<VertexField> read_medit_solution(const std::string& path, Index num_vertices) {
  const std::string content = read_file(path);
  TextReader reader(path, content, {'#', false});
  std::optional<std::vector<VertexField>> fields;
  for_sections(reader, [&](std::string_view keyword) {
    if (keyword != "SolAtVertices" || fields) return false;
    fields = read_solution(reader, num_vertices);
    return true;
  });
  if (!fields) reader.fail("the file has no section SolAtVertices");
  for (std::size_t k = 0; k < fields->size(); ++k) {
    (*fields)[k].name = name_of_field(content, static_cast<Index>(k));
  }
  return std::move(*fields);
}

void write_medit_mesh(std::ostream& out, const DomainMesh<3>& mesh) {
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
}

void write_medit_solution(std::ostream& out, const std::vector<VertexField>& fields) {
  TextWriter writer(out);
  writer << "MeshVersionFormatted 2\nDimension 3\n";
  for (std::size_t k = 0; k < fields.size(); ++k) {
    writer << kNameComment << k << " " << fields[k].name << "\n";
  }
  const Eigen::Index num_vertices = fields.empty() ? 0 : fields.front().values.size();
  writer << "SolAtVertices\n" << num_vertices << "\n" << fields.size();
  for (std::size_t k = 0; k < fields.size(); ++k) writer << " 1";
  writer << "\n";
  for (Eigen::Index v = 0; v < num_vertices; ++v) {
    for (std::size_t k = 0; k < fields.size(); ++k) {
      writer << (k > 0 ? " " : "") << fields[k].values[v];
    }
    writer << "\n";
  }
  writer << "End\n";
  writer.flush();
}

std::string solution_path(const std::string& path) {
  return std::filesystem::path(path).replace_extension(".sol").string();
}

}  // namespace

DomainMesh<3> read_medit(const std::string& path, std::vector<VertexField>* fields) {
  auto mesh = read_medit_mesh(path);
  const std::string solution = solution_path(path);
  if (fields && std::filesystem::exists(solution)) {
    *fields = read_medit_solution(solution, mesh.num_vertices());
  }
  return mesh;
}

void write_medit(const std::string& path, const DomainMesh<3>& mesh,
                 const std::vector<VertexField>& fields) {
  // If one of the two files cannot be written, neither is created.
  write_file(path, [&](std::ostream& out) {
    write_medit_mesh(out, mesh);
    out.flush();
    if (!out || fields.empty()) return;
    write_file(solution_path(path),
               [&](std::ostream& solution) { write_medit_solution(solution, fields); });
  });
}

}  // namespace flbc::io
