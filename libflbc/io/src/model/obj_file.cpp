// SPDX-License-Identifier: BSD-3-Clause
#include <charconv>
#include <cstdint>
#include <limits>
#include <system_error>

#include "flbc/io/files.h"
#include "flbc/io/polygon_file.h"
#include "text/text_reader.h"
#include "text/text_writer.h"

namespace flbc::io {
namespace {

// Faces may stand before their vertices, so whether an index is too large shows only at the end of
// the file; the largest one and its line are enough to tell.
class LargestIndex {
 public:
  void see(Index index, std::int64_t line) {
    if (index <= index_) return;
    index_ = index;
    line_ = line;
  }
  void check(const TextReader& reader, std::size_t num_points) const {
    if (index_ < static_cast<std::int64_t>(num_points)) return;
    reader.fail_at(line_,
                   out_of_range_message(std::int64_t{index_} + 1, "vertices", 1, num_points));
  }

 private:
  Index index_ = -1;
  std::int64_t line_ = 1;
};

bool is_integer(std::string_view text) {
  std::int64_t value = 0;
  const char* const end = text.data() + text.size();
  const auto parsed = std::from_chars(text.data(), end, value);
  return parsed.ec == std::errc() && parsed.ptr == end;
}

// Texture and normal indices are of no use here, but a word like "3/x" means a damaged file.
bool are_optional_indices(std::string_view text) {
  for (int part = 0; part < 2; ++part) {
    const std::size_t slash = text.find('/');
    const std::string_view digits = text.substr(0, slash);
    if (!digits.empty() && !is_integer(digits)) return false;
    if (slash == std::string_view::npos) return true;
    text.remove_prefix(slash + 1);
  }
  return false;
}

// "i", "i/t", "i/t/n" or "i//n"; i counts from 1, or backwards from the latest vertex if negative.
Index parse_corner(const TextReader& reader, std::string_view word, std::size_t num_points) {
  const std::size_t slash = word.find('/');
  const std::string_view digits = word.substr(0, slash);
  std::int64_t number = 0;
  const auto parsed = std::from_chars(digits.data(), digits.data() + digits.size(), number);
  const bool is_number =
      parsed.ec != std::errc::invalid_argument && parsed.ptr == digits.data() + digits.size() &&
      (slash == std::string_view::npos || are_optional_indices(word.substr(slash + 1)));
  if (!is_number) reader.fail_expected("a vertex index", word);
  if (number == 0 && parsed.ec == std::errc()) {
    reader.fail("the index 0 is out of range; vertices are numbered from 1");
  }
  const std::int64_t index =
      number > 0 ? number - 1 : static_cast<std::int64_t>(num_points) + number;
  if (parsed.ec != std::errc() || index < 0 || index >= std::numeric_limits<Index>::max()) {
    reader.fail("the index " + quoted(digits) + " is out of range; there are " +
                std::to_string(num_points) + " vertices before this line");
  }
  return static_cast<Index>(index);
}

std::vector<Index> read_corners(TextReader& reader, const char* what, std::size_t at_least,
                                std::size_t num_points, LargestIndex& largest) {
  const std::int64_t line = reader.line();
  std::vector<Index> corners;
  while (reader.has_word()) {
    corners.push_back(parse_corner(reader, reader.word(), num_points));
    largest.see(corners.back(), reader.line());
  }
  if (corners.size() < at_least) {
    reader.fail_at(line, std::string(what) + " needs at least " + std::to_string(at_least) +
                             " vertices, found " + std::to_string(corners.size()));
  }
  return corners;
}

// Planar curves may lack z. After x, y, z a weight or a colour may follow.
Vector<3> read_point(TextReader& reader) {
  Vector<3> point;
  point[0] = reader.number();
  point[1] = reader.number();
  point[2] = 0;
  if (reader.has_word()) point[2] = reader.number();
  while (reader.has_word()) reader.number();
  return point;
}

}  // namespace

PolygonSoup read_obj(const std::string& path) {
  TextReader reader(path, read_file(path), {'#', true});
  PolygonSoup soup;
  LargestIndex largest;
  while (reader.next_line()) {
    const std::string_view keyword = reader.word();
    if (keyword == "v") {
      soup.points.push_back(read_point(reader));
    } else if (keyword == "f") {
      soup.polygons.push_back(read_corners(reader, "a face", 3, soup.points.size(), largest));
    } else if (keyword == "l") {
      soup.polylines.push_back(read_corners(reader, "a polyline", 2, soup.points.size(), largest));
    }
  }
  if (soup.points.empty()) reader.fail("the file ends without a vertex (\"v\" line)");
  largest.check(reader, soup.points.size());
  return soup;
}

void write_obj(const std::string& path, const PolygonSoup& soup) {
  write_file(path, [&](std::ostream& out) {
    TextWriter writer(out);
    for (const Vector<3>& p : soup.points) {
      writer << "v " << p[0] << " " << p[1] << " " << p[2] << "\n";
    }
    const auto write_all = [&](const char* keyword, const auto& elements) {
      for (const std::vector<Index>& corners : elements) {
        writer << keyword;
        for (const Index corner : corners) writer << " " << std::int64_t{corner} + 1;
        writer << "\n";
      }
    };
    write_all("l", soup.polylines);
    write_all("f", soup.polygons);
    writer.flush();
  });
}

}  // namespace flbc::io
