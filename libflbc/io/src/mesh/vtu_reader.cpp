// SPDX-License-Identifier: BSD-3-Clause
// Reads VTK's XML format for unstructured grids, as text: arrays of points, of the cells' points
// one after another, of where each cell's points end, of the kinds of cells, and of point data.
#include <algorithm>
#include <iterator>

#include "base/messages.h"
#include "flbc/errors.h"
#include "flbc/io/files.h"
#include "mesh/mesh_formats.h"
#include "text/xml_reader.h"

namespace flbc::io {
namespace {

// VTK's numbers for kinds of cells.
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
      : path_(path), xml_(path, read_file(path)), fields_(fields) {}

  DomainMesh<Dim> read() {
    if (!xml_.next_tag() || xml_.name() != "VTKFile") {
      xml_.fail("not a VTK file: the first tag must be <VTKFile>");
    }
    if (xml_.attribute("type") != "UnstructuredGrid") {
      xml_.fail("the file has a grid of type " + in_quotes(xml_.attribute("type")) +
                ", not \"UnstructuredGrid\"");
    }
    while (read_tag()) {
    }
    if (num_pieces_ == 0) xml_.fail("the file has no grid");
    return mesh();
  }

 private:
  // \return false at the end of the grid
  bool read_tag() {
    if (!xml_.next_tag()) xml_.fail("the file ends before </UnstructuredGrid>");
    const std::string& name = xml_.name();
    if (name == "UnstructuredGrid") return !xml_.is_end_tag();
    if (name == "Points" || name == "Cells" || name == "PointData" || name == "CellData" ||
        name == "FieldData") {
      section_ = xml_.is_end_tag() ? "" : name;
    } else if (name == "Piece" && !xml_.is_end_tag()) {
      if (++num_pieces_ > 1) xml_.fail("the grid has more than one piece; only one is supported");
      num_points_ = read_attribute("NumberOfPoints");
      num_cells_ = read_attribute("NumberOfCells");
    } else if (name == "DataArray" && !xml_.is_end_tag()) {
      read_array();
    }
    return true;
  }

  std::size_t read_attribute(const std::string& name) {
    TextReader reader(path_, xml_.attribute(name), {}, line());
    if (!reader.next_word_on_any_line()) xml_.fail("the tag <Piece> has no attribute " + name);
    return static_cast<std::size_t>(reader.count(name.c_str(), 0));
  }

  void read_array() {
    const std::string name = xml_.attribute("Name");
    if (section_ == "Points") {
      points_ = read_numbers(name, 3 * num_points_);
    } else if (section_ == "Cells") {
      if (name == "connectivity") connectivity_ = read_integers(name);
      if (name == "offsets") offsets_ = read_integers(name, num_cells_);
      if (name == "types") kinds_ = read_integers(name, num_cells_);
    } else if (section_ == "PointData" && fields_) {
      const std::string components = xml_.attribute("NumberOfComponents");
      if (!components.empty() && components != "1") return;  // vectors are no weights
      const auto values = read_numbers(name, num_points_);
      fields_->push_back({name, Eigen::Map<const Eigen::VectorXd>(
                                    values.data(), static_cast<Eigen::Index>(values.size()))});
    }
  }

  TextReader array_text(const std::string& name) {
    if (num_pieces_ == 0) xml_.fail("an array stands outside of <Piece>");
    const std::string format = xml_.attribute("format");
    if (!format.empty() && format != "ascii") {
      xml_.fail("the array " + in_quotes(name) + " has the format " + in_quotes(format) +
                "; only \"ascii\" is supported: save the file in ASCII mode");
    }
    return xml_.text();
  }

  void check_size(const std::string& name, std::size_t found, std::size_t expected) const {
    if (found == expected) return;
    xml_.fail("the array " + in_quotes(name) + " has " + std::to_string(found) + " numbers, not " +
              std::to_string(expected));
  }

  std::vector<double> read_numbers(const std::string& name, std::size_t count) {
    TextReader reader = array_text(name);
    std::vector<double> numbers;
    while (reader.next_word_on_any_line()) numbers.push_back(reader.number());
    check_size(name, numbers.size(), count);
    return numbers;
  }

  std::vector<std::int64_t> read_integers(const std::string& name) {
    TextReader reader = array_text(name);
    std::vector<std::int64_t> numbers;
    while (reader.next_word_on_any_line()) numbers.push_back(reader.integer());
    return numbers;
  }
  std::vector<std::int64_t> read_integers(const std::string& name, std::size_t count) {
    auto numbers = read_integers(name);
    check_size(name, numbers.size(), count);
    return numbers;
  }

  std::int64_t line() const { return xml_.line(); }

  [[noreturn]] void fail_cell(std::size_t cell, const std::string& defect) const {
    throw InputError(path_ + ": cell " + std::to_string(cell) + ": " + defect);
  }

  DomainMesh<Dim> mesh() const {
    if (points_.size() != 3 * num_points_ || num_points_ == 0) xml_.fail("the grid has no points");
    if (offsets_.size() != num_cells_ || kinds_.size() != num_cells_) {
      xml_.fail("the grid has no arrays \"offsets\" and \"types\" of its cells");
    }
    DomainMesh<Dim> result;
    result.points = points();
    std::vector<Index> corners;
    std::int64_t begin = 0;
    for (std::size_t s = 0; s < num_cells_; ++s) {
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
    const Eigen::Map<const PointList<3>> all(points_.data(), 3,
                                             static_cast<Eigen::Index>(num_points_));
    if constexpr (Dim == 2) {
      for (Eigen::Index v = 0; v < all.cols(); ++v) {
        if (all(2, v) == 0) continue;
        throw InputError(path_ + ": vertex " + std::to_string(v) + " at " +
                         format_point(all.col(v)) + " does not lie in the plane z = 0");
      }
    }
    return all.template topRows<Dim>();
  }

  // Whether a cell is part of the domain, rather than of its boundary.
  bool is_used(std::size_t cell) const {
    const std::int64_t kind = kinds_[cell];
    if (kind == (Dim == 2 ? kTriangle : kTetrahedronType)) return true;
    if (Dim == 2 ? contains(kKindsBelow2D, kind) : contains(kKindsBelow3D, kind)) return false;
    fail_cell(cell, "cells of VTK's type " + std::to_string(kind) + " are not supported; " +
                        (Dim == 2 ? "they must be triangles (type 5)"
                                  : "they must be tetrahedra with 4 points (type 10)"));
  }

  void append_corners(std::size_t cell, std::int64_t begin, std::int64_t end,
                      std::vector<Index>& corners) const {
    if (end - begin != Dim + 1) {
      fail_cell(cell, "it has " + std::to_string(end - begin) + " points, not " +
                          std::to_string(Dim + 1));
    }
    for (std::int64_t k = begin; k < end; ++k) {
      const std::int64_t point = connectivity_[static_cast<std::size_t>(k)];
      if (point < 0 || static_cast<std::size_t>(point) >= num_points_) {
        fail_cell(cell, out_of_range_message(point, "points", 0, num_points_));
      }
      corners.push_back(static_cast<Index>(point));
    }
  }

  std::string path_;
  XmlReader xml_;
  std::vector<VertexField>* fields_;
  std::string section_;
  int num_pieces_ = 0;
  std::size_t num_points_ = 0;
  std::size_t num_cells_ = 0;
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
