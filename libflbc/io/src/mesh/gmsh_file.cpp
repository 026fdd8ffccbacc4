// SPDX-License-Identifier: BSD-3-Clause
// Gmsh .msh in text form, versions 2 and, for reading, 4.1: sections between $Name and $EndName;
// nodes and elements have arbitrary tags. Only tetrahedra are used; points, curves, and surfaces
// are skipped.
#include <algorithm>
#include <iterator>
#include <unordered_map>

#include "flbc/io/files.h"
#include "mesh/mesh_formats.h"
#include "text/text_reader.h"

namespace flbc::io {
namespace {

// Gmsh element types.
constexpr std::int64_t kTetrahedron = 4;
// Points, lines, triangles and quadrilaterals of first and second order.
constexpr std::int64_t kKindsOnBoundaries[] = {15, 1, 2, 3, 8, 9, 10, 16};

class GmshReader {
 public:
  explicit GmshReader(const std::string& path) : reader_(path, read_file(path), {}) {}

  DomainMesh<3> read() {
    read_format();
    while (reader_.next_line()) {
      const std::string name(reader_.word());
      if (name[0] != '$') reader_.fail_expected("the start of a section", name);
      if (name == "$Nodes") {
        if (!index_of_.empty()) reader_.fail("a second section $Nodes");
        for_blocks("blocks of nodes", [&](std::int64_t) { read_nodes(); });
        expect_end("$EndNodes");
      } else if (name == "$Elements") {
        if (!cells_.empty()) reader_.fail("a second section $Elements");
        for_blocks("blocks of elements", [&](std::int64_t kind) { read_elements(kind); });
        expect_end("$EndElements");
      } else if (name == "$ParametricNodes") {
        reader_.fail(
            "the section $ParametricNodes is not supported; save the file without "
            "parametric coordinates");
      } else {
        skip_to("$End" + name.substr(1));
      }
    }
    if (index_of_.empty()) reader_.fail("the file has no nodes");
    if (cells_.empty()) reader_.fail("the file has no tetrahedra");
    return mesh();
  }

 private:
  void read_format() {
    const std::string first(reader_.next_line() ? reader_.word() : "");
    if (first == "$NOD") {
      reader_.fail(
          "Gmsh version 1 is not supported; convert it by gmsh OLD.msh -save -format msh2 -o "
          "NEW.msh");
    }
    if (first.find_first_not_of("0123456789") == std::string::npos && !first.empty()) {
      reader_.fail(
          "not a Gmsh file; it looks like a mesh of FreeFem: save it there by savegmsh(), or in 3D "
          "by savemesh() with a name that ends in .mesh");
    }
    if (first != "$MeshFormat") {
      reader_.fail("not a Gmsh file: the first line must be $MeshFormat");
    }
    if (!reader_.next_line()) reader_.fail("the file ends before its version");
    const std::string version(reader_.word());
    is_version_4_ = version == "4.1";
    if (!is_version_4_ && version != "2" && version.substr(0, 2) != "2.") {
      reader_.fail("version " + in_quotes(version) + " is not supported, only 2.2 and 4.1");
    }
    if (reader_.integer() != 0) {
      reader_.fail("binary Gmsh files are not supported; save the mesh as text");
    }
    skip_to("$EndMeshFormat");
  }

  void skip_to(const std::string& end) {
    while (reader_.next_line()) {
      if (reader_.word() == end) return;
    }
    reader_.fail("the file ends before " + in_quotes(end));
  }

  void expect_end(const char* end) {
    if (!reader_.next_line()) reader_.fail("the file ends before " + in_quotes(end));
    const std::string_view found = reader_.word();
    if (found != end) reader_.fail_expected(in_quotes(end), found);
  }

  void next_section_line() {
    if (!reader_.next_line()) reader_.fail("the file ends inside a section");
  }

  void add_node(std::int64_t tag, const Vector<3>& point) {
    if (!index_of_.emplace(tag, static_cast<Index>(points_.size())).second) {
      reader_.fail("node " + std::to_string(tag) + " occurs twice");
    }
    points_.push_back(point);
  }

  void add_tetrahedron() {
    Vertices& cell = cells_.emplace_back();
    for (Index& vertex : cell) {
      const std::int64_t tag = reader_.integer();
      const auto found = index_of_.find(tag);
      if (found == index_of_.end()) {
        reader_.fail("the element refers to node " + std::to_string(tag) +
                     ", which does not exist");
      }
      vertex = found->second;
    }
  }

  // \return whether elements of this kind are cells of the mesh, not of its boundary
  bool is_tetrahedron(std::int64_t kind) const {
    if (kind == kTetrahedron) return true;
    const auto end = std::end(kKindsOnBoundaries);
    if (std::find(std::begin(kKindsOnBoundaries), end, kind) != end) return false;
    reader_.fail("Gmsh elements of type " + std::to_string(kind) +
                 " are not supported; cells must be tetrahedra with 4 nodes (type 4)");
  }

  // Version 4 has "BLOCKS COUNT MINTAG MAXTAG", then blocks, which start with three integers.
  // \param read  reads a block, after the third of them; version 2 has one block and none of these
  template <class Read>
  void for_blocks(const char* blocks, const Read& read) {
    next_section_line();
    if (!is_version_4_) return read(0);
    const Index num_blocks = reader_.count("blocks", 8);
    for (Index b = 0; b < num_blocks; ++b) {
      reader_.next_line_of(blocks, b, num_blocks);
      for (int k = 0; k < 2; ++k) reader_.integer();
      read(reader_.integer());
    }
  }

  // A block of version 4 has first the tags of its nodes, then their coordinates.
  void read_nodes() {
    const Index count = reader_.count("nodes", 8);
    std::vector<std::int64_t> tags(is_version_4_ ? count : 0);
    for (std::size_t v = 0; v < tags.size(); ++v) {
      reader_.next_line_of("tags of nodes", static_cast<Index>(v), count);
      tags[v] = reader_.integer();
    }
    for (Index v = 0; v < count; ++v) {
      reader_.next_line_of("nodes", v, count);
      const std::int64_t tag = is_version_4_ ? tags[v] : reader_.integer();
      add_node(tag, reader_.point());
    }
  }

  // \param kind  of all elements in version 4
  void read_elements(std::int64_t kind) {
    const bool is_used = is_version_4_ && is_tetrahedron(kind);
    const Index count = reader_.count("elements", is_version_4_ ? 4 : 6);
    for (Index s = 0; s < count; ++s) {
      reader_.next_line_of("elements", s, count);
      reader_.integer();
      if (is_version_4_) {
        if (is_used) add_tetrahedron();
      } else if (kind = reader_.integer(); is_tetrahedron(kind)) {
        for (Index k = reader_.count("tags", 2); k > 0; --k) reader_.integer();
        add_tetrahedron();
      }
    }
  }

  DomainMesh<3> mesh() const {
    DomainMesh<3> result;
    result.points.resize(3, static_cast<Eigen::Index>(points_.size()));
    for (std::size_t v = 0; v < points_.size(); ++v) result.points.col(v) = points_[v];
    result.cells.resize(4, static_cast<Eigen::Index>(cells_.size()));
    for (std::size_t s = 0; s < cells_.size(); ++s) result.cells.col(s) = cells_[s];
    return result;
  }

  using Vertices = Eigen::Matrix<Index, 4, 1>;

  TextReader reader_;
  bool is_version_4_ = false;
  std::unordered_map<std::int64_t, Index> index_of_;
  std::vector<Vector<3>> points_;
  std::vector<Vertices> cells_;
};

}  // namespace

DomainMesh<3> read_gmsh(const std::string& path) {
  return GmshReader(path).read();
}

void write_gmsh(const std::string& path, const DomainMesh<3>& mesh,
                const std::vector<VertexField>&) {
  write_file(path, [&](std::ostream& out) {
    TextWriter writer(out);
    writer << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n";
    writer << "$Nodes\n" << mesh.num_vertices() << "\n";
    for (Index v = 0; v < mesh.num_vertices(); ++v) {
      writer << v + std::int64_t{1} << " ";
      write_point(writer, mesh, v);
      writer << "\n";
    }
    writer << "$EndNodes\n$Elements\n" << mesh.num_cells() << "\n";
    for (Index s = 0; s < mesh.num_cells(); ++s) {
      // Type 4 is a tetrahedron; the 2 tags assign it to physical and elementary volume 1.
      writer << s + std::int64_t{1} << " 4 2 1 1";
      write_cell(writer, mesh, s, 1);
    }
    writer << "$EndElements\n";
    writer.flush();
  });
}

}  // namespace flbc::io
