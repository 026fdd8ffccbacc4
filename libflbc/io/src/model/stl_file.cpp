// SPDX-License-Identifier: BSD-3-Clause
// STL stores triangles with a normal and three points each; coincident points are one vertex.
#include <algorithm>
#include <cmath>
#include <string_view>
#include <unordered_map>

#include "flbc/errors.h"
#include "model/model_scan.h"
#include "text/bytes.h"
#include "text/float_chars.h"
#include "text/text_reader.h"

namespace flbc::io {
namespace {

constexpr std::size_t kHeaderBytes = 80;
constexpr std::size_t kBytesBeforeTriangles = kHeaderBytes + sizeof(std::uint32_t);
constexpr std::size_t kBytesPerTriangle = 12 * sizeof(float) + sizeof(std::uint16_t);

using Single = Eigen::Vector3f;

struct Hash {
  std::size_t operator()(const Single& point) const {
    std::size_t hash = 0;
    for (const float coordinate : point) {
      hash = hash * 1000003 + std::hash<float>()(coordinate);  // the same for 0 and -0
    }
    return hash;
  }
};

// Rounds once, from decimal to single precision; too small numbers become 0.
float to_single(std::string_view word) {
  if (word[0] == '+') word.remove_prefix(1);
  float value = 0;
  const auto parsed = from_chars(word.data(), word.data() + word.size(), value);
  return parsed.ec == std::errc() ? value : 0;
}

class StlScanner {
 public:
  StlScanner(const std::string& path, ModelScan& scan)
      : path_(path), scan_(scan), soup_(scan.model.soup) {}

  void run() {
    scan_.model.is_text = is_text();
    if (scan_.model.is_text) {
      scan_text();
    } else {
      scan_binary();
    }
    if (soup_.polygons.empty()) throw InputError(path_ + ": the file has no triangles");
    scan_.face_normals = Eigen::Map<const PointList<3>>(
        normals_.data(), 3, static_cast<Eigen::Index>(soup_.polygons.size()));
    keep_finite<3>(scan_.model, scan_.face_normals);
  }

 private:
  // Binary files may begin with "solid" too.
  bool is_text() const {
    const auto& text = scan_.text;
    const bool has_binary_size =
        text.size() >= kBytesBeforeTriangles &&
        text.size() == kBytesBeforeTriangles +
                           kBytesPerTriangle * number_at<std::uint32_t>(text.data() + kHeaderBytes);
    if (has_binary_size) return false;
    const std::size_t begin = std::min(text.find_first_not_of(" \t\r\n"), text.size());
    return lower_case(std::string_view(text).substr(begin, 5)) == "solid";
  }

  void scan_binary() {
    const auto& bytes = scan_.text;
    if (bytes.size() < kBytesBeforeTriangles) throw InputError(path_ + ": not an STL file");
    const std::size_t declared = number_at<std::uint32_t>(bytes.data() + kHeaderBytes);
    const std::size_t held = (bytes.size() - kBytesBeforeTriangles) / kBytesPerTriangle;
    if (declared > held) {
      throw InputError(path_ + ": the file ends after " + std::to_string(held) + " of " +
                       std::to_string(declared) + " triangles");
    }
    add_other(scan_.model, "the header");
    for (std::size_t t = 0; t < declared; ++t) {
      std::size_t position = kBytesBeforeTriangles + t * kBytesPerTriangle;
      begin_triangle(binary_numbers(position));
      for (int k = 0; k < 3; ++k) add_corner(binary_numbers(position));
      if (number_at<std::uint16_t>(bytes.data() + position) != 0) {
        add_other(scan_.model, "attributes of triangles");
      }
    }
  }

  PlacedNumbers binary_numbers(std::size_t& position) const {
    PlacedNumbers numbers;
    for (int d = 0; d < 3; ++d) {
      numbers.places[d] = {position, sizeof(float), NumberForm::kFloat};
      numbers.values[d] = number_at<float>(scan_.text.data() + position);
      position += sizeof(float);
    }
    return numbers;
  }

  void scan_text() {
    TextReader reader(path_, scan_.text, {});
    std::size_t corners = 3;
    bool is_open = true;
    while (reader.next_line()) {
      std::string keyword = lower_case(reader.word());
      if (keyword == "end")
        keyword += lower_case(reader.word());  // some programs write "end solid"
      if ((keyword == "facet" || keyword == "endfacet") && corners < 3) {
        reader.fail("a facet has fewer than 3 vertices");
      }
      if (keyword == "facet") {
        reader.word();  // normal
        begin_triangle(next_numbers(reader, scan_.text.size(), 0, TripleKind::kFaceNormal));
        corners = 0;
      } else if (keyword == "vertex") {
        if (++corners > 3) reader.fail("a facet has more than 3 vertices");
        auto numbers = next_numbers(reader, scan_.text.size(), 3, TripleKind::kPoint);
        for (int d = 0; d < 3; ++d) {
          const auto& place = numbers.places[d];
          numbers.values[d] =
              to_single(std::string_view(scan_.text).substr(place.begin, place.size));
        }
        add_corner(numbers);
      } else if (keyword == "solid" || keyword == "endsolid") {
        is_open = keyword == "solid";
        if (is_open && reader.has_word()) add_other(scan_.model, "the name of the solid");
      }
    }
    if (corners < 3) reader.fail("the file ends within a facet");
    if (is_open) reader.fail("the file ends within a solid: \"endsolid\" is missing");
  }

  void begin_triangle(const PlacedNumbers& normal) {
    const auto face = static_cast<Index>(soup_.polygons.size());
    soup_.polygons.emplace_back();
    normals_.insert(normals_.end(), normal.values.begin(), normal.values.end());
    add_sites(scan_, normal.places, TripleKind::kFaceNormal, face);
  }

  void add_corner(const PlacedNumbers& numbers) {
    const Single point = numbers.values.cast<float>();
    if (!point.allFinite()) {
      throw InputError(path_ + ": a vertex of triangle " +
                       std::to_string(soup_.polygons.size() - 1) + " is not finite");
    }
    const auto next = static_cast<Index>(soup_.points.size());
    const auto [found, is_new] = vertices_.emplace(point, next);
    if (is_new) soup_.points.push_back(point.cast<double>());
    soup_.polygons.back().push_back(found->second);
    add_sites(scan_, numbers.places, TripleKind::kPoint, found->second);
  }

  const std::string& path_;
  ModelScan& scan_;
  PolygonSoup& soup_;
  std::vector<double> normals_;
  std::unordered_map<Single, Index, Hash> vertices_;
};

}  // namespace

void read_stl(const std::string& path, Extent, ModelScan& scan) {
  StlScanner(path, scan).run();
}

}  // namespace flbc::io
