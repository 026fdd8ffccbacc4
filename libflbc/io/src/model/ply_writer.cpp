// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <cstring>
#include <string_view>

#include "flbc/errors.h"
#include "model/model_scan.h"
#include "text/text_writer.h"

namespace flbc::io {
namespace {

// Numbers as words with blanks between, or as little-endian bytes.
class PlyNumbers {
 public:
  PlyNumbers(TextWriter& writer, bool is_text) : writer_(writer), is_text_(is_text) {}

  template <class Stored, class Number>
  void put(Number number) {
    if (is_text_) {
      if (!is_first_) writer_ << " ";
      writer_ << number;
    } else {
      const auto stored = static_cast<Stored>(number);
      if (!std::isfinite(static_cast<double>(number))) {
        throw InputError("a number to be written is not finite");
      }
      char bytes[sizeof stored];
      std::memcpy(bytes, &stored, sizeof stored);
      writer_ << std::string_view(bytes, sizeof stored);
    }
    is_first_ = false;
  }

  void end_row() {
    if (is_text_) writer_ << "\n";
    is_first_ = true;
  }

 private:
  TextWriter& writer_;
  bool is_text_;
  bool is_first_ = true;
};

void write_header(TextWriter& writer, const Model& model, const VertexAttributes& attributes,
                  bool has_large_polygons) {
  writer << "ply\nformat " << (model.is_text ? "ascii" : "binary_little_endian")
         << " 1.0\nelement vertex " << model.soup.points.size() << "\n";
  const auto declare = [&writer](const char* type, std::initializer_list<const char*> names) {
    for (const char* name : names) writer << "property " << type << " " << name << "\n";
  };
  declare("double", {"x", "y", "z"});
  if (attributes.normals.cols() > 0) declare("double", {"nx", "ny", "nz"});
  if (attributes.texture.cols() > 0) declare("double", {"s", "t"});
  if (attributes.colors.cols() > 0) declare("uchar", {"red", "green", "blue"});
  writer << "element face " << model.soup.polygons.size() << "\nproperty list "
         << (has_large_polygons ? "int" : "uchar") << " int vertex_indices\nend_header\n";
}

}  // namespace

void write_ply(std::ostream& out, const Model& model) {
  const auto& [points, polygons, polylines] = model.soup;
  const VertexAttributes attributes(model);
  const bool has_large_polygons = std::any_of(
      polygons.begin(), polygons.end(), [](const auto& polygon) { return polygon.size() > 255; });
  TextWriter writer(out);
  write_header(writer, model, attributes, has_large_polygons);
  PlyNumbers numbers(writer, model.is_text);
  const auto put_all = [&numbers](const auto& row) {
    for (const double number : row) numbers.put<double>(number);
  };
  for (std::size_t v = 0; v < points.size(); ++v) {
    put_all(points[v]);
    if (attributes.normals.cols() > 0) put_all(attributes.normals.col(v));
    if (attributes.texture.cols() > 0) put_all(attributes.texture.col(v));
    if (attributes.colors.cols() > 0) {
      for (const double c : attributes.colors.col(v)) numbers.put<std::uint8_t>(level_of(c));
    }
    numbers.end_row();
  }
  for (const auto& polygon : polygons) {
    if (has_large_polygons) {
      numbers.put<std::int32_t>(polygon.size());
    } else {
      numbers.put<std::uint8_t>(polygon.size());
    }
    for (const Index vertex : polygon) numbers.put<std::int32_t>(vertex);
    numbers.end_row();
  }
  writer.flush();
}

}  // namespace flbc::io
