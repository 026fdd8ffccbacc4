// SPDX-License-Identifier: BSD-3-Clause
#include <string_view>

#include "flbc/io/files.h"
#include "model/model_attributes.h"
#include "model/model_scan.h"
#include "text/text_place.h"
#include "text/text_reader.h"
#include "text/text_writer.h"

namespace flbc::io {
namespace {

// Finds the numbers to exchange and what a Model has no place for. read_obj() and
// read_obj_attributes() have accepted the file before.
class ObjScanner {
 public:
  ObjScanner(const std::string& path, ModelScan& scan)
      : scan_(scan), reader_(path, scan.text, {'#', true}) {}

  void run() {
    while (reader_.next_line()) {
      const std::string_view keyword = reader_.word();
      if (keyword == "v") {
        add_vertex();
      } else if (keyword == "vn") {
        add_triple(TripleKind::kNormal, normal_++);
      } else if (keyword == "vt") {
        for (int k = 0; k < 2; ++k) reader_.word();
        if (reader_.has_word()) add_other(scan_.model, "third texture coordinates");
      } else if (keyword == "l") {
        while (reader_.has_word()) {
          if (reader_.word().find('/') != std::string_view::npos) {
            add_other(scan_.model, "texture coordinates of polylines");
          }
        }
      } else if (keyword != "f") {
        add_other(scan_.model, "lines with " + quoted(keyword));
      }
    }
    if (scan_.text.find('#') != std::string::npos) add_other(scan_.model, "comments");
  }

 private:
  void add_triple(TripleKind kind, Index index) {
    add_sites(scan_, next_numbers(reader_, scan_.text).places, kind, index);
  }

  void add_vertex() {
    add_triple(TripleKind::kPoint, point_++);
    int more = 0;
    for (; reader_.has_word(); ++more) reader_.word();
    if (more == 0) return;
    const bool has_colors = scan_.model.attributes.colors.cols() > 0;
    if (!has_colors) add_other(scan_.model, "numbers after the coordinates of vertices");
    if (has_colors && more > 3) add_other(scan_.model, "transparency");
  }

  ModelScan& scan_;
  TextReader reader_;
  Index point_ = 0;
  Index normal_ = 0;
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
  const auto& colors = model.attributes.colors;
  for (std::size_t v = 0; v < model.soup.points.size(); ++v) {
    const Vector<3>& p = model.soup.points[v];
    writer << "v " << p[0] << " " << p[1] << " " << p[2];
    if (colors.cols() > 0) {
      for (const double intensity : colors.col(v)) writer << " " << intensity;
    }
    writer << "\n";
  }
  for (const auto& t : model.attributes.texture_coordinates.colwise()) {
    writer << "vt " << t[0] << " " << t[1] << "\n";
  }
  for (const auto& n : model.attributes.normals.colwise()) {
    writer << "vn " << n[0] << " " << n[1] << " " << n[2] << "\n";
  }
}

}  // namespace

ModelScan scan_obj(const std::string& path) {
  ModelScan scan;
  scan.text = read_file(path);
  scan.model.soup = read_obj(path);
  scan.model.attributes = read_obj_attributes(path, scan.model.soup);
  ObjScanner(path, scan).run();
  return scan;
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
