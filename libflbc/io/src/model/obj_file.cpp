// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <charconv>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <system_error>

#include "model/model_scan.h"
#include "text/text_reader.h"
#include "text/text_writer.h"

namespace flbc::io {
namespace {

// References to vertices, which may follow in the file, so the range check is at its end. It needs
// only the largest reference and its line.
class VertexReferences {
 public:
  //! \param number  from 1, or backwards from the latest of `seen` if negative
  //! \param digits  the number as text, because it may be too large for its type
  //! \return from 0
  Index resolve(const TextReader& reader, std::int64_t number, std::size_t seen,
                std::string_view digits) {
    const std::int64_t index = number >= 0 ? number - 1 : static_cast<std::int64_t>(seen) + number;
    if ((number < 0 && index < 0) || index >= std::numeric_limits<Index>::max()) {
      reader.fail("the index " + in_quotes(digits) + " is out of range; there are " +
                  std::to_string(seen) + " vertices before this line");
    }
    if (index > largest_) {
      largest_ = index;
      line_ = reader.line();
    }
    return static_cast<Index>(index);
  }

  void check(const TextReader& reader, std::size_t count) const {
    if (largest_ < static_cast<std::int64_t>(count)) return;
    reader.fail_at(line_, out_of_range_message(largest_ + 1, "vertices", 1, count));
  }

 private:
  std::int64_t largest_ = -1;
  std::int64_t line_ = 1;
};

// The numbers of "i", "i/t", "i/t/n" or "i//n"; 0 for a missing one.
struct ObjCorner {
  std::int64_t vertex = 0;
  std::int64_t texture_coordinate = 0;
  std::int64_t normal = 0;
};

// \throws InputError if the word is none of these
inline ObjCorner parse_corner(const TextReader& reader, std::string_view word) {
  ObjCorner corner;
  std::string_view rest = word;
  for (auto* const number : {&corner.vertex, &corner.texture_coordinate, &corner.normal}) {
    const std::size_t slash = rest.find('/');
    const std::string_view digits = rest.substr(0, slash);
    const bool is_vertex = number == &corner.vertex;
    if (is_vertex || !digits.empty()) {
      const char* const end = digits.data() + digits.size();
      const auto [stop, error] = std::from_chars(digits.data(), end, *number);
      const bool is_huge = error == std::errc::result_out_of_range;
      if (stop != end || error == std::errc::invalid_argument || (is_huge && !is_vertex)) break;
      constexpr auto kHuge = std::numeric_limits<std::int64_t>::max();
      if (is_huge) *number = digits[0] == '-' ? -kHuge : kHuge;
    }
    if (slash == std::string_view::npos) return corner;
    rest.remove_prefix(slash + 1);
  }
  reader.fail_expected("a vertex index", word);
}

template <int Dim>
PointList<Dim> to_matrix(const std::vector<Vector<Dim>>& columns) {
  PointList<Dim> matrix(Dim, columns.size());
  for (std::size_t k = 0; k < columns.size(); ++k) matrix.col(k) = columns[k];
  return matrix;
}

class ObjReader {
 public:
  ObjReader(const std::string& path, Extent extent, ModelScan& scan)
      : path_(path),
        scan_(scan),
        model_(scan.model),
        reads_attributes_(extent == Extent::kEverything),
        reader_(path, scan.text, {'#', true}) {}

  void run() {
    while (reader_.next_line()) read_line(reader_.word());
    if (model_.soup.points.empty()) {
      reader_.fail("the file ends without a vertex (\"v\" line)");
    }
    vertices_.check(reader_, model_.soup.points.size());
    if (curve_line_ > 0 && model_.soup.polygons.empty()) {
      reader_.fail_at(curve_line_,
                      "curves and free-form surfaces (\"curv\", \"surf\") are not "
                      "supported; export polygons");
    }
    if (!reads_attributes_) return;
    drop_dangling_references();
    model_.attributes.texture_coordinates = to_matrix<2>(texture_coordinates_);
    model_.attributes.normals = to_matrix<3>(normals_);
    keep_finite<2>(model_, model_.attributes.texture_coordinates);
    keep_finite<3>(model_, model_.attributes.normals);
    finish_colors();
    finish_materials();
    if (scan_.text.find('#') != std::string::npos) add_other(model_, "comments");
  }

 private:
  void read_line(std::string_view keyword) {
    if (keyword == "v") {
      read_vertex();
    } else if (keyword == "f") {
      read_corners(true);
    } else if (keyword == "l") {
      read_corners(false);
    } else if (keyword == "curv" || keyword == "curv2" || keyword == "surf") {
      if (curve_line_ == 0) curve_line_ = reader_.line();
      add_other(model_, "lines with " + in_quotes(keyword));
    } else if (keyword == "mtllib" || keyword == "usemtl") {
      // Always read, because it may continue on the next line.
      read_material(keyword, rest_of_line(reader_));
    } else if (!reads_attributes_) {
      return;
    } else if (keyword == "vt" || keyword == "vn") {
      const std::int64_t line = reader_.line();
      keyword == "vt" ? read_texture_coordinate() : read_normal();
      if (reader_.line() == line) return;
      // If skipped, the rest would be parsed as a separate line.
      reader_.fail(
          "a texture coordinate (\"vt\") or normal (\"vn\") is continued on another line; it must "
          "be on one");
    } else {
      add_other(model_, "lines with " + in_quotes(keyword));
    }
  }

  void read_material(std::string_view keyword, std::string name) {
    if (!reads_attributes_) return;
    add_other(model_, "lines with " + in_quotes(keyword));
    keyword == "mtllib" ? material_files_.push_back(std::move(name)) : use_material(name);
  }

  void use_material(const std::string& name) {
    auto& materials = model_.materials;
    const auto found = std::find_if(materials.begin(), materials.end(),
                                    [&](const auto& known) { return known.name == name; });
    material_ = static_cast<Index>(found - materials.begin());
    if (found == materials.end()) materials.emplace_back().name = name;
  }

  void finish_materials() {
    if (model_.materials.empty()) return;
    polygon_materials_.resize(model_.soup.polygons.size(), material_);
    model_.polygon_materials = std::move(polygon_materials_);
    for (const auto& name : material_files_) {
      const auto file = path_next_to(path_, name);
      if (!read_mtl(file, model_.materials)) model_.missing_files.push_back(file);
    }
  }

  // Coordinates (planar curves lack z), optionally followed by a weight, or by a color with or
  // without alpha.
  void read_vertex() {
    const auto numbers = next_numbers(reader_, scan_.text.size(), 2, TripleKind::kPoint);
    add(numbers.places, TripleKind::kPoint, model_.soup.points.size());
    model_.soup.points.push_back(numbers.values);
    std::vector<double> others;
    while (reader_.has_word()) others.push_back(reader_.any_number());
    if (others.size() == 3 || others.size() == 4) {
      colors_.emplace_back(others[0], others[1], others[2]);
    }
    most_others_ = std::max(most_others_, others.size());
  }

  void read_corners(bool is_face) {
    const std::int64_t line = reader_.line();
    std::vector<Index> vertices;
    std::vector<CornerReferences> references;
    while (reader_.has_word()) {
      const std::string_view word = reader_.word();
      const ObjCorner corner = parse_corner(reader_, word);
      if (corner.vertex == 0) {
        reader_.fail("the index 0 is out of range; vertices are numbered from 1");
      }
      const std::size_t slash = word.find('/');
      vertices.push_back(vertices_.resolve(reader_, corner.vertex, model_.soup.points.size(),
                                           word.substr(0, slash)));
      if (!reads_attributes_) continue;
      if (is_face) references.push_back(resolve(corner));
      if (!is_face && slash != std::string_view::npos) {
        add_other(model_, "texture coordinates of polylines");
      }
    }
    if (vertices.size() < 2) {
      reader_.fail_at(line, std::string(is_face ? "a face" : "a polyline") +
                                " needs at least 2 vertices, found " +
                                std::to_string(vertices.size()));
    }
    // A face of two vertices is an edge.
    is_face &= vertices.size() > 2;
    (is_face ? model_.soup.polygons : model_.soup.polylines).push_back(std::move(vertices));
    if (!reads_attributes_ || !is_face) return;
    model_.attributes.corners.push_back(std::move(references));
    polygon_materials_.push_back(material_);
  }

  CornerReferences resolve(const ObjCorner& corner) const {
    // The lists may follow in the file, so what is not there is found at its end.
    const auto index = [](std::int64_t number, std::size_t seen) {
      constexpr Index kMissing = std::numeric_limits<Index>::max();
      const auto result = number >= 0 ? number - 1 : static_cast<std::int64_t>(seen) + number;
      const bool is_missing = number != 0 && (result < 0 || result > kMissing);
      return is_missing ? kMissing : static_cast<Index>(result);
    };
    return {index(corner.texture_coordinate, texture_coordinates_.size()),
            index(corner.normal, normals_.size())};
  }

  // Files that were cut from others refer to attributes that are not there.
  void drop_dangling_references() {
    bool are_dangling = false;
    const auto check = [&](Index& reference, std::size_t count) {
      if (reference < static_cast<std::int64_t>(count)) return;
      reference = -1;
      are_dangling = true;
    };
    for (auto& polygon : model_.attributes.corners) {
      for (auto& corner : polygon) {
        check(corner.texture_coordinate, texture_coordinates_.size());
        check(corner.normal, normals_.size());
      }
    }
    if (are_dangling) {
      add_other(model_, "references to texture coordinates or normals that are not in the file");
    }
  }

  void read_texture_coordinate() {
    const double u = reader_.any_number();
    texture_coordinates_.emplace_back(u, reader_.has_word() ? reader_.any_number() : 0);
    if (reader_.has_word()) add_other(model_, "third texture coordinates");
  }

  void read_normal() {
    const auto numbers = next_numbers(reader_, scan_.text.size(), 3, TripleKind::kNormal);
    add(numbers.places, TripleKind::kNormal, normals_.size());
    normals_.push_back(numbers.values);
  }

  void add(const std::array<NumberPlace, 3>& places, TripleKind kind, std::size_t index) {
    if (reads_attributes_) add_sites(scan_, places, kind, static_cast<Index>(index));
  }

  void finish_colors() {
    const PointList<3> colors = to_matrix<3>(colors_);
    if (colors_.size() == model_.soup.points.size() && are_colors(colors)) {
      model_.attributes.colors = colors;
      if (most_others_ > 3) add_other(model_, "transparency");
    } else if (most_others_ > 0) {
      add_other(model_, "numbers after the coordinates of vertices");
    }
  }

  const std::string& path_;
  ModelScan& scan_;
  Model& model_;
  bool reads_attributes_;
  TextReader reader_;
  std::int64_t curve_line_ = 0;  // of the first curve or free-form surface; 0 = none
  std::size_t most_others_ = 0;  // numbers after the coordinates of a vertex
  std::vector<Vector<2>> texture_coordinates_;
  std::vector<Vector<3>> normals_;
  std::vector<Vector<3>> colors_;
  std::vector<std::string> material_files_;
  std::vector<Index> polygon_materials_;
  Index material_ = -1;  // of the following polygons
  VertexReferences vertices_;
};

void write_corner(TextWriter& writer, Index vertex, const CornerReferences& references) {
  writer << " " << std::int64_t{vertex} + 1;
  const auto [texture, normal] = references;
  if (texture < 0 && normal < 0) return;
  writer << "/";
  if (texture >= 0) writer << std::int64_t{texture} + 1;
  if (normal >= 0) writer << "/" << std::int64_t{normal} + 1;
}

void write_vertices(TextWriter& writer, const Model& model) {
  const auto& [texture_coordinates, normals, colors, corners] = model.attributes;
  for (std::size_t v = 0; v < model.soup.points.size(); ++v) {
    const Vector<3>& p = model.soup.points[v];
    writer << "v " << p[0] << " " << p[1] << " " << p[2];
    if (colors.cols() > 0) {
      for (const double intensity : colors.col(v)) writer << " " << intensity;
    }
    writer << "\n";
  }
  for (const auto& t : texture_coordinates.colwise()) {
    writer << "vt " << t[0] << " " << t[1] << "\n";
  }
  for (const auto& n : normals.colwise()) {
    writer << "vn " << n[0] << " " << n[1] << " " << n[2] << "\n";
  }
}

}  // namespace

void read_obj(const std::string& path, Extent extent, ModelScan& scan) {
  ObjReader(path, extent, scan).run();
}

void write_obj(std::ostream& out, const Model& model) {
  TextWriter writer(out);
  write_vertices(writer, model);
  for (const auto& polyline : model.soup.polylines) {
    writer << "l";
    for (const Index vertex : polyline) writer << " " << std::int64_t{vertex} + 1;
    writer << "\n";
  }
  const auto& corners = model.attributes.corners;
  for (std::size_t f = 0; f < model.soup.polygons.size(); ++f) {
    const auto& polygon = model.soup.polygons[f];
    writer << "f";
    for (std::size_t k = 0; k < polygon.size(); ++k) {
      write_corner(writer, polygon[k], corners.empty() ? CornerReferences{} : corners[f][k]);
    }
    writer << "\n";
  }
  writer.flush();
}

}  // namespace flbc::io
