// SPDX-License-Identifier: BSD-3-Clause
#include <string>

#include "flbc/io/files.h"
#include "flbc/io/polygon_file.h"
#include "text/text_reader.h"
#include "text/text_writer.h"

namespace flbc::io {
namespace {

// The header is [ST][C][N]OFF: texture coordinates, colours and normals follow each vertex, where
// they are ignored. "4" and "n" change the number of coordinates.
void read_header(TextReader& reader) {
  if (!reader.next_line()) reader.fail("not an OFF file: it is empty");
  const std::string_view found = reader.word();
  std::string_view rest = found;
  for (const std::string_view prefix : {"ST", "C", "N"}) {
    if (rest.substr(0, prefix.size()) == prefix) rest.remove_prefix(prefix.size());
  }
  if (rest == "4OFF" || rest == "nOFF" || rest == "4nOFF") {
    reader.fail("the header " + quoted(found) +
                " is not supported: points must have 3 coordinates");
  }
  if (rest != "OFF") reader.fail("not an OFF file: expected OFF, found " + quoted(found));
}

}  // namespace

PolygonSoup read_off(const std::string& path) {
  TextReader reader(path, read_file(path), {'#', false});
  read_header(reader);
  if (!reader.next_word_on_any_line()) reader.fail("the file ends before the number of vertices");
  if (reader.peek() == "BINARY") reader.fail("binary OFF files are not supported");
  const Index num_points = reader.count("vertices", 6);
  const Index num_polygons = reader.count("faces", 8);
  // The number of edges, which may follow, tells nothing.

  PolygonSoup soup;
  soup.points.reserve(static_cast<std::size_t>(num_points));
  for (Index v = 0; v < num_points; ++v) {
    reader.next_line_of("vertices", v, num_points);
    soup.points.push_back(reader.point());
  }
  soup.polygons.reserve(static_cast<std::size_t>(num_polygons));
  for (Index f = 0; f < num_polygons; ++f) {
    reader.next_line_of("faces", f, num_polygons);
    const Index num_corners = reader.count("corners", 2);
    if (num_corners < 3) {
      reader.fail("a face needs at least 3 vertices, found " + std::to_string(num_corners));
    }
    std::vector<Index>& corners = soup.polygons.emplace_back(num_corners);
    for (Index& corner : corners) corner = reader.index("vertices", 0, num_points);
  }
  if (reader.next_line()) {
    reader.fail_expected("the end of the file after the last face", reader.word());
  }
  return soup;
}

void write_off(const std::string& path, const PolygonSoup& soup) {
  write_file(path, [&](std::ostream& out) {
    TextWriter writer(out);
    writer << "OFF\n" << soup.points.size() << " " << soup.polygons.size() << " 0\n";
    for (const Vector<3>& p : soup.points) writer << p[0] << " " << p[1] << " " << p[2] << "\n";
    for (const std::vector<Index>& corners : soup.polygons) {
      writer << corners.size();
      for (const Index corner : corners) writer << " " << corner;
      writer << "\n";
    }
    writer.flush();
  });
}

}  // namespace flbc::io
