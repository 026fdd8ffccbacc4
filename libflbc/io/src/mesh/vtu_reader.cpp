// SPDX-License-Identifier: BSD-3-Clause
// Reads the VTK XML format for unstructured grids, as text: arrays of points, cell connectivity,
// cell offsets, cell types, and point data.
#include <algorithm>
#include <iterator>
#include <type_traits>

#include <pugixml.hpp>

#include "base/messages.h"
#include "flbc/errors.h"
#include "flbc/io/files.h"
#include "mesh/mesh_formats.h"
#include "text/text_reader.h"

namespace flbc::io {
namespace {

// VTK cell types.
constexpr std::int64_t kTriangle = 5;
constexpr std::int64_t kTetrahedronType = 10;
constexpr std::int64_t kKindsBelow2D[] = {1, 2, 3, 4, 21, 35, 68};
constexpr std::int64_t kKindsBelow3D[] = {1,  2,  3,  4,  5,  6,  7,  8,  9, 21,
                                          22, 23, 28, 34, 35, 36, 68, 69, 70};

template <class Kinds>
bool contains(const Kinds& kinds, std::int64_t kind) {
  return std::find(std::begin(kinds), std::end(kinds), kind) != std::end(kinds);
}

template <int Dim>
class VtuReader {
 public:
  VtuReader(const std::string& path, std::vector<VertexField>* fields)
      : path_(path), content_(read_file(path)), fields_(fields) {}

  DomainMesh<Dim> read() {
    pugi::xml_document document;
    const auto parsed = document.load_buffer(content_.data(), content_.size(), pugi::parse_default,
                                             pugi::encoding_utf8);
    const auto file = document.document_element();
    if (file.name() != std::string("VTKFile")) {
      fail(file, "not a VTK file: the first tag must be <VTKFile>");
    }
    const std::string type = file.attribute("type").value();
    // Raw data at the end of a file are not XML; their arrays are rejected below.
    if (!parsed && !file.child("AppendedData")) {
      fail_at(parsed.offset, std::string("the XML is malformed: ") + parsed.description());
    }
    if (type != "UnstructuredGrid") {
      fail(file, "the file has a grid of type " + in_quotes(type) + ", not \"UnstructuredGrid\"");
    }
    const auto piece = file.child("UnstructuredGrid").child("Piece");
    if (!piece) fail(file, "the file has no grid");
    if (const auto second = piece.next_sibling("Piece")) {
      fail(second, "the grid has more than one piece; only one is supported");
    }
    read_piece(piece);
    return mesh();
  }

 private:
  void read_piece(const pugi::xml_node& piece) {
    num_points_ = read_count(piece, "NumberOfPoints");
    num_cells_ = read_count(piece, "NumberOfCells");
    const auto points = piece.child("Points").child("DataArray");
    if (!points || num_points_ == 0) fail(piece, "the grid has no points");
    points_ = read_array<double>(points, 3 * std::int64_t{num_points_});
    const auto cells_array = [&](const char* name) {
      const auto array = piece.child("Cells").find_child_by_attribute("DataArray", "Name", name);
      if (!array) fail(piece, "the cells of the grid have no array " + in_quotes(name));
      return array;
    };
    connectivity_ = read_array<std::int64_t>(cells_array("connectivity"), -1);
    offsets_ = read_array<std::int64_t>(cells_array("offsets"), num_cells_);
    kinds_ = read_array<std::int64_t>(cells_array("types"), num_cells_);
    if (fields_ == nullptr) return;
    for (const auto& array : piece.child("PointData").children("DataArray")) {
      const std::string components = array.attribute("NumberOfComponents").value();
      if (!components.empty() && components != "1") continue;  // skips vectors
      const auto values = read_array<double>(array, num_points_);
      fields_->push_back({array.attribute("Name").value(),
                          Eigen::Map<const Eigen::VectorXd>(
                              values.data(), static_cast<Eigen::Index>(values.size()))});
    }
  }

  Index read_count(const pugi::xml_node& piece, const char* name) const {
    TextReader reader(path_, piece.attribute(name).value(), {}, line_of(piece.offset_debug()));
    if (!reader.next_word_on_any_line()) {
      fail(piece, std::string("the tag <Piece> has no attribute ") + name);
    }
    return reader.count(name, 0);
  }

  // \param count  how many numbers the array must have; -1: any number
  template <class Number>
  std::vector<Number> read_array(const pugi::xml_node& array, std::int64_t count) const {
    const auto name = in_quotes(array.attribute("Name").value());
    const std::string format = array.attribute("format").value();
    if (!format.empty() && format != "ascii") {
      fail(array, "the array " + name + " has the format " + in_quotes(format) +
                      "; only \"ascii\" is supported: save the file in ASCII mode");
    }
    const auto text = array.text();
    TextReader reader(path_, text.get(), {}, line_of(text.data().offset_debug()));
    std::vector<Number> numbers;
    while (reader.next_word_on_any_line()) {
      if constexpr (std::is_integral_v<Number>) {
        numbers.push_back(reader.integer());
      } else {
        numbers.push_back(reader.number());
      }
    }
    if (count >= 0 && numbers.size() != static_cast<std::size_t>(count)) {
      fail(array, "the array " + name + " has " + std::to_string(numbers.size()) +
                      " numbers, not " + std::to_string(count));
    }
    return numbers;
  }

  std::int64_t line_of(std::ptrdiff_t offset) const {
    const auto length =
        std::clamp<std::ptrdiff_t>(offset, 0, static_cast<std::ptrdiff_t>(content_.size()));
    return 1 + std::count(content_.begin(), content_.begin() + length, '\n');
  }

  [[noreturn]] void fail_at(std::ptrdiff_t offset, const std::string& message) const {
    throw InputError(path_ + ":" + std::to_string(line_of(offset)) + ": " + message);
  }
  [[noreturn]] void fail(const pugi::xml_node& node, const std::string& message) const {
    fail_at(node.offset_debug(), message);
  }

  [[noreturn]] void fail_cell(Index cell, const std::string& defect) const {
    throw InputError(path_ + ": cell " + std::to_string(cell) + ": " + defect);
  }

  DomainMesh<Dim> mesh() const {
    DomainMesh<Dim> result;
    result.points = points();
    std::vector<Index> corners;
    std::int64_t begin = 0;
    for (Index s = 0; s < num_cells_; ++s) {
      const std::int64_t end = offsets_[s];
      if (end < begin || static_cast<std::size_t>(end) > connectivity_.size()) {
        fail_cell(s, "its offset " + std::to_string(end) + " is out of range");
      }
      if (is_used(s)) append_corners(s, begin, end, corners);
      begin = end;
    }
    result.cells = Eigen::Map<const CellList<Dim>>(
        corners.data(), Dim + 1, static_cast<Eigen::Index>(corners.size() / (Dim + 1)));
    return result;
  }

  PointList<Dim> points() const {
    const Eigen::Map<const PointList<3>> all(points_.data(), 3, num_points_);
    if constexpr (Dim == 2) {
      for (Eigen::Index v = 0; v < all.cols(); ++v) {
        if (all(2, v) == 0) continue;
        throw InputError(path_ + ": vertex " + std::to_string(v) + " at " +
                         format_point(all.col(v)) + " is not in the plane z = 0");
      }
    }
    return all.template topRows<Dim>();
  }

  // Whether a cell is part of the domain, rather than of its boundary.
  bool is_used(Index cell) const {
    const std::int64_t kind = kinds_[cell];
    if (kind == (Dim == 2 ? kTriangle : kTetrahedronType)) return true;
    if (Dim == 2 ? contains(kKindsBelow2D, kind) : contains(kKindsBelow3D, kind)) return false;
    fail_cell(cell,
              "VTK cells of type " + std::to_string(kind) + " are not supported; " +
                  (Dim == 2 ? "they must be triangles (type 5)"
                            : "they must be tetrahedra with 4 points (type 10); flbc deform "
                              "--domain moves any cells if the points are raw appended data"));
  }

  void append_corners(Index cell, std::int64_t begin, std::int64_t end,
                      std::vector<Index>& corners) const {
    if (end - begin != Dim + 1) {
      fail_cell(cell, "it has " + std::to_string(end - begin) + " points, not " +
                          std::to_string(Dim + 1));
    }
    for (std::int64_t k = begin; k < end; ++k) {
      const std::int64_t point = connectivity_[static_cast<std::size_t>(k)];
      if (point < 0 || point >= num_points_) {
        fail_cell(cell, out_of_range_message(point, "points", 0, num_points_));
      }
      corners.push_back(static_cast<Index>(point));
    }
  }

  std::string path_;
  std::string content_;
  std::vector<VertexField>* fields_;
  Index num_points_ = 0;
  Index num_cells_ = 0;
  std::vector<double> points_;
  std::vector<std::int64_t> connectivity_;
  std::vector<std::int64_t> offsets_;
  std::vector<std::int64_t> kinds_;
};

}  // namespace

template <int Dim>
DomainMesh<Dim> read_vtu(const std::string& path, std::vector<VertexField>* fields) {
  return VtuReader<Dim>(path, fields).read();
}

template DomainMesh<2> read_vtu(const std::string&, std::vector<VertexField>*);
template DomainMesh<3> read_vtu(const std::string&, std::vector<VertexField>*);

}  // namespace flbc::io
