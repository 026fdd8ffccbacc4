// SPDX-License-Identifier: BSD-3-Clause
// OFF with attributes: the header is [ST][C][N]OFF, and each vertex has its coordinates, normal,
// colour and texture coordinates in this order.
#include <algorithm>
#include <limits>
#include <string_view>
#include <vector>

#include "flbc/io/files.h"
#include "model/model_attributes.h"
#include "model/model_scan.h"
#include "text/text_place.h"
#include "text/text_reader.h"
#include "text/text_writer.h"

namespace flbc::io {
namespace {

bool take(std::string_view& text, std::string_view prefix) {
  if (text.substr(0, prefix.size()) != prefix) return false;
  text.remove_prefix(prefix.size());
  return true;
}

// read_off() has accepted the file before.
class OffScanner {
 public:
  OffScanner(const std::string& path, ModelScan& scan)
      : scan_(scan), model_(scan.model), reader_(path, scan.text, {'#', false}) {}

  void run() {
    read_header();
    for (std::size_t v = 0; v < model_.soup.points.size(); ++v) read_vertex(static_cast<Index>(v));
    finish_colors();
    refer_to_vertices(model_);
    for (const auto& polygon : model_.soup.polygons) {
      reader_.next_line();
      for (std::size_t k = 0; k <= polygon.size(); ++k) reader_.word();
      if (reader_.has_word()) add_other(model_, "colours of polygons");
    }
    if (scan_.text.find('#') != std::string::npos) add_other(model_, "comments");
  }

 private:
  void read_header() {
    reader_.next_line();
    std::string_view header = reader_.word();
    has_texture_ = take(header, "ST");
    has_colors_ = take(header, "C");
    has_normals_ = take(header, "N");
    reader_.next_word_on_any_line();  // the numbers of vertices, faces and edges
    const auto num_points = static_cast<Eigen::Index>(model_.soup.points.size());
    if (has_texture_) model_.attributes.texture_coordinates.resize(2, num_points);
    if (has_colors_) model_.attributes.colors.resize(3, num_points);
    if (has_normals_) model_.attributes.normals.resize(3, num_points);
  }

  PlacedNumbers add_triple(TripleKind kind, Index index) {
    const auto numbers = next_numbers(reader_, scan_.text);
    add_sites(scan_, numbers.places, kind, index);
    return numbers;
  }

  void read_vertex(Index v) {
    reader_.next_line();
    add_triple(TripleKind::kPoint, v);
    if (has_normals_) model_.attributes.normals.col(v) = add_normal(v);

    std::vector<double> numbers;
    std::size_t num_integers = 0;  // before the first number that is none
    while (reader_.has_word()) {
      const bool is_integer = reader_.peek().find_first_of(".eE") == std::string_view::npos;
      if (is_integer && num_integers == numbers.size()) ++num_integers;
      numbers.push_back(reader_.number());
    }
    if (has_texture_) {
      if (numbers.size() < 2) reader_.fail("expected texture coordinates after the coordinates");
      const std::size_t at = numbers.size() - 2;
      model_.attributes.texture_coordinates.col(v) << numbers[at], numbers[at + 1];
      numbers.resize(at);
    }
    are_levels_ &= num_integers >= numbers.size();
    read_color(v, numbers);
  }

  Vector<3> add_normal(Index v) {
    const auto normal = add_triple(TripleKind::kNormal, v);
    if (normal.places.back().size == 0) reader_.fail("expected a normal after the coordinates");
    return normal.values;
  }

  void read_color(Index v, const std::vector<double>& numbers) {
    if (has_colors_ && (numbers.size() == 3 || numbers.size() == 4)) {
      model_.attributes.colors.col(v) << numbers[0], numbers[1], numbers[2];
      if (numbers.size() == 4) least_alpha_ = std::min(least_alpha_, numbers[3]);
    } else if (has_colors_ || !numbers.empty()) {
      are_colors_ = false;  // a single number, for example, names a colour of a table
    }
  }

  // Whole numbers are levels from 0 to 255, others are from 0 to 1.
  void finish_colors() {
    auto& colors = model_.attributes.colors;
    const double largest = are_levels_ ? 255 : 1;
    colors /= largest;
    are_colors_ &= (colors.array() >= 0 && colors.array() <= 1).all();
    if (are_colors_ && least_alpha_ < largest) add_other(model_, "transparency");
    if (are_colors_) return;
    colors.resize(3, 0);
    add_other(model_, "numbers after the coordinates of vertices");
  }

  ModelScan& scan_;
  Model& model_;
  TextReader reader_;
  bool has_texture_ = false;
  bool has_colors_ = false;
  bool has_normals_ = false;
  bool are_levels_ = true;
  bool are_colors_ = true;
  double least_alpha_ = std::numeric_limits<double>::infinity();
};

}  // namespace

ModelScan scan_off(const std::string& path) {
  ModelScan scan;
  scan.text = read_file(path);
  scan.model.soup = read_off(path);
  OffScanner(path, scan).run();
  return scan;
}

void write_off(std::ostream& out, const Model& model) {
  const auto& points = model.soup.points;
  const auto& polygons = model.soup.polygons;
  const auto& colors = model.attributes.colors;
  const auto normals = normals_at_vertices(model).value_or(PointList<3>());
  const auto texture = texture_coordinates_at_vertices(model).value_or(PointList<2>());
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
