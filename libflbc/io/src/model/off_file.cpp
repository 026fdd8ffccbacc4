// SPDX-License-Identifier: BSD-3-Clause
// OFF: the header is [ST][C][N]OFF or missing, and each vertex has its coordinates, normal, color,
// and texture coordinates in this order. Many files, such as those of ModelNet, have no blank
// between the header and the number of vertices.
#include <algorithm>
#include <limits>
#include <string_view>
#include <vector>

#include "model/model_scan.h"
#include "text/text_writer.h"

namespace flbc::io {
namespace {

bool take(std::string_view& text, std::string_view prefix) {
  if (text.substr(0, prefix.size()) != prefix) return false;
  text.remove_prefix(prefix.size());
  return true;
}

class OffReader {
 public:
  OffReader(const std::string& path, Extent extent, ModelScan& scan)
      : scan_(scan),
        model_(scan.model),
        reads_attributes_(extent == Extent::kEverything),
        reader_(path, scan.text, {'#', false}) {}

  void run() {
    read_header();
    const Index num_points = reader_.count("vertices", 6);
    const Index num_polygons = reader_.count("faces", 8);
    // The optional number of edges is ignored.
    allocate(num_points, num_polygons);
    for (Index v = 0; v < num_points; ++v) {
      reader_.next_line_of("vertices", v, num_points);
      read_vertex(v);
    }
    if (reads_attributes_) finish_colors();
    for (Index f = 0; f < num_polygons; ++f) {
      reader_.next_line_of("faces", f, num_polygons);
      read_polygon(num_points);
    }
    // Some programs write text there, but numbers are more faces than declared.
    if (reader_.next_line() && reader_.peek().find_first_of("0123456789") == 0) {
      reader_.fail_expected("the end of the file after the last face", reader_.word());
    }
    if (!reads_attributes_) return;
    keep_finite<2>(model_, model_.attributes.texture_coordinates);
    keep_finite<3>(model_, model_.attributes.normals);
    refer_to_vertices(model_);
    if (scan_.text.find('#') != std::string::npos) add_other(model_, "comments");
  }

 private:
  // "4" and "n" change the number of coordinates.
  void read_header() {
    if (!reader_.next_line()) reader_.fail("not an OFF file: it is empty");
    const std::string_view found = reader_.word();
    std::string_view rest = found;
    has_texture_ = take(rest, "ST");
    has_colors_ = take(rest, "C");
    has_normals_ = take(rest, "N");
    if (rest == "4OFF" || rest == "nOFF" || rest == "4nOFF") {
      reader_.fail("the header " + in_quotes(found) +
                   " is not supported: points must have 3 coordinates");
    }
    const auto is_number = [](std::string_view text) {
      return text.find_first_not_of("0123456789") == std::string_view::npos;
    };
    if ((!take(rest, "OFF") && rest.size() < found.size()) || !is_number(rest)) {
      reader_.fail("not an OFF file: expected OFF, found " + in_quotes(found));
    }
    reader_.put_back(rest.size());
    if (!reader_.next_word_on_any_line()) {
      reader_.fail("the file ends before the number of vertices");
    }
    if (reader_.peek() == "BINARY") reader_.fail("binary OFF files are not supported");
  }

  void allocate(Index num_points, Index num_polygons) {
    model_.soup.points.reserve(static_cast<std::size_t>(num_points));
    model_.soup.polygons.reserve(static_cast<std::size_t>(num_polygons));
    if (!reads_attributes_) return;
    if (has_texture_) model_.attributes.texture_coordinates.resize(2, num_points);
    if (has_colors_) model_.attributes.colors.resize(3, num_points);
    if (has_normals_) model_.attributes.normals.resize(3, num_points);
  }

  void read_vertex(Index v) {
    const auto point = next_numbers(reader_, scan_.text.size(), 3, TripleKind::kPoint);
    model_.soup.points.push_back(point.values);
    if (!reads_attributes_) return;
    add_sites(scan_, point.places, TripleKind::kPoint, v);
    if (has_normals_) {
      const auto normal = next_numbers(reader_, scan_.text.size(), 3, TripleKind::kNormal);
      add_sites(scan_, normal.places, TripleKind::kNormal, v);
      model_.attributes.normals.col(v) = normal.values;
    }
    std::vector<double> numbers;
    std::size_t num_integers = 0;  // before the first non-integer
    while (reader_.has_word()) {
      const bool is_integer = reader_.peek().find_first_of(".eE") == std::string_view::npos;
      if (is_integer && num_integers == numbers.size()) ++num_integers;
      numbers.push_back(reader_.any_number());
    }
    if (has_texture_) {
      if (numbers.size() < 2) reader_.fail("expected texture coordinates after the coordinates");
      const std::size_t at = numbers.size() - 2;
      model_.attributes.texture_coordinates.col(v) << numbers[at], numbers[at + 1];
      numbers.resize(at);
    }
    are_levels_ &= num_integers >= numbers.size();
    take_color(v, numbers);
  }

  void take_color(Index v, const std::vector<double>& numbers) {
    if (has_colors_ && (numbers.size() == 3 || numbers.size() == 4)) {
      model_.attributes.colors.col(v) << numbers[0], numbers[1], numbers[2];
      if (numbers.size() == 4) least_alpha_ = std::min(least_alpha_, numbers[3]);
    } else if (has_colors_ || !numbers.empty()) {
      are_colors_ = false;  // for example, a single number is a color table index
    }
  }

  void read_polygon(Index num_points) {
    const Index num_corners = reader_.count("corners", 2);
    if (num_corners < 2) {
      reader_.fail("a face needs at least 2 vertices, found " + std::to_string(num_corners));
    }
    auto& elements = num_corners == 2 ? model_.soup.polylines : model_.soup.polygons;
    std::vector<Index>& corners = elements.emplace_back(num_corners);
    for (Index& corner : corners) corner = reader_.index("vertices", 0, num_points);
    if (reads_attributes_ && reader_.has_word()) add_other(model_, "colors of polygons");
  }

  // Integers are levels from 0 to 255, other numbers are in [0, 1].
  void finish_colors() {
    auto& colors = model_.attributes.colors;
    const double largest = are_levels_ ? 255 : 1;
    colors /= largest;
    are_colors_ = are_colors_ && are_colors(colors);
    if (are_colors_ && least_alpha_ < largest) add_other(model_, "transparency");
    if (are_colors_) return;
    colors.resize(3, 0);
    add_other(model_, "numbers after the coordinates of vertices");
  }

  ModelScan& scan_;
  Model& model_;
  bool reads_attributes_;
  TextReader reader_;
  bool has_texture_ = false;
  bool has_colors_ = false;
  bool has_normals_ = false;
  bool are_levels_ = true;
  bool are_colors_ = true;
  double least_alpha_ = std::numeric_limits<double>::infinity();
};

}  // namespace

void read_off(const std::string& path, Extent extent, ModelScan& scan) {
  OffReader(path, extent, scan).run();
}

void write_off(std::ostream& out, const Model& model) {
  const auto& points = model.soup.points;
  const auto& polygons = model.soup.polygons;
  const VertexAttributes attributes(model);
  const auto& [normals, texture, colors] = attributes;
  TextWriter writer(out);
  const auto write_row = [&](const auto& row) {
    for (const double number : row) writer << " " << number;
  };
  writer << (texture.cols() > 0 ? "ST" : "") << (colors.cols() > 0 ? "C" : "")
         << (normals.cols() > 0 ? "N" : "") << "OFF\n"
         << points.size() << " " << polygons.size() << " 0\n";
  for (std::size_t v = 0; v < points.size(); ++v) {
    writer << points[v][0] << " " << points[v][1] << " " << points[v][2];
    if (normals.cols() > 0) write_row(normals.col(v));
    if (colors.cols() > 0) {
      for (const double intensity : colors.col(v)) writer << " " << level_of(intensity);
      writer << " 255";
    }
    if (texture.cols() > 0) write_row(texture.col(v));
    writer << "\n";
  }
  for (const auto& polygon : polygons) {
    writer << polygon.size();
    for (const Index vertex : polygon) writer << " " << vertex;
    writer << "\n";
  }
  writer.flush();
}

}  // namespace flbc::io
