// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/io/polygon_text.h"

#include <algorithm>
#include <charconv>
#include <limits>
#include <ostream>
#include <string_view>

#include <Eigen/Geometry>

#include "flbc/errors.h"
#include "flbc/io/files.h"
#include "text_reader.h"
#include "text_writer.h"

namespace flbc::io {
namespace {

// Twice the area of a polygon along its normal, also if it is not planar. Relative to a corner,
// so that polygons far from the origin keep their digits.
Vector<3> area_vector(const std::vector<Index>& corners, const std::vector<Vector<3>>& points) {
  const Vector<3>& origin = points[corners.front()];
  Vector<3> area = Vector<3>::Zero();
  for (std::size_t k = 2; k < corners.size(); ++k) {
    const Vector<3> edge = points[corners[k - 1]] - origin;
    area += edge.cross(points[corners[k]] - origin);
  }
  return area;
}

// The third part of "v/vt/vn", 0 if there is none.
std::int64_t normal_number(std::string_view corner) {
  const std::size_t slash = corner.rfind('/');
  if (slash == std::string_view::npos || corner.find('/') == slash) return 0;
  std::int64_t number = 0;
  std::from_chars(corner.data() + slash + 1, corner.data() + corner.size(), number);
  return number;  // one that is too large for 64 bits counts as none
}

}  // namespace

// Finds the numbers to exchange. read_obj() or read_off() has accepted the file before.
class PolygonText::Scanner {
 public:
  Scanner(const std::string& path, PolygonText& target, TextReader::Syntax syntax)
      : target_(target), reader_(path, target.text_, syntax) {}

  void scan_obj() {
    Index num_points = 0;
    while (reader_.next_line()) {
      const std::string_view keyword = reader_.word();
      if (keyword == "v") {
        add_vertex(num_points++);
        while (reader_.has_word()) reader_.word();  // colours, maybe on a line that continues this
      } else if (keyword == "vn") {
        add_normal();
      } else if (keyword == "f") {
        add_corner_normals();
      }
    }
    require_same_elements(num_points);
    const auto num_normals = target_.normals_.size();
    if (largest_ < static_cast<std::int64_t>(num_normals)) return;
    reader_.fail_at(largest_line_, out_of_range_message(largest_ + 1, "normals", 1, num_normals));
  }

  void scan_off() {
    reader_.next_line();
    const bool has_normals = reader_.word().find('N') != std::string_view::npos;
    reader_.next_word_on_any_line();  // the numbers of vertices, faces and edges
    for (std::size_t v = 0; v < target_.soup_.points.size(); ++v) {
      reader_.next_line();
      add_vertex(static_cast<Index>(v));
      if (has_normals) add_normal();
    }
    target_.corner_normals_ = target_.soup_.polygons;
    if (has_normals) return;
    for (auto& corners : target_.corner_normals_) std::fill(corners.begin(), corners.end(), -1);
  }

 private:
  // read_obj() ignores normals, and so takes a line that continues one for a line of its own.
  void require_same_elements(Index num_points) const {
    const auto& polygons = target_.soup_.polygons;
    const bool same = num_points == static_cast<Index>(target_.soup_.points.size()) &&
                      std::equal(polygons.begin(), polygons.end(), target_.corner_normals_.begin(),
                                 target_.corner_normals_.end(),
                                 [](const auto& a, const auto& b) { return a.size() == b.size(); });
    if (!same) reader_.fail("a normal (\"vn\") is continued on another line; it must be on one");
  }

  // Where the next word stands. A word of its own: a line may be continued in the middle.
  Span next_span() {
    reader_.has_word();
    return {target_.text_.size() - reader_.bytes_left(), reader_.peek().size()};
  }

  void add_vertex(Index index) {
    Triple triple{{}, false, index};
    for (int k = 0; k < 3; ++k) {
      triple.spans[k] = next_span();
      if (triple.spans[k].size == 0) {  // a planar curve without z, after whose y it would stand
        triple.spans[k] = {triple.spans[k - 1].begin + triple.spans[k - 1].size, 0};
      }
      reader_.word();
    }
    target_.triples_.push_back(triple);
  }

  void add_normal() {
    Triple triple{{}, true, static_cast<Index>(target_.normals_.size())};
    Vector<3> normal;
    for (int k = 0; k < 3; ++k) {
      triple.spans[k] = next_span();
      normal[k] = reader_.number();
    }
    target_.triples_.push_back(triple);
    target_.normals_.push_back(normal);
  }

  void add_corner_normals() {
    auto& corners = target_.corner_normals_.emplace_back();
    while (reader_.has_word()) {
      const std::int64_t number = normal_number(reader_.word());
      const auto seen = static_cast<std::int64_t>(target_.normals_.size());
      const std::int64_t index = number >= 0 ? number - 1 : seen + number;
      if (index < -1 || (number < 0 && index < 0) || index >= std::numeric_limits<Index>::max()) {
        reader_.fail("the normal " + std::to_string(number) + " is out of range; there are " +
                     std::to_string(seen) + " normals before this line");
      }
      if (index > largest_) {
        largest_ = index;
        largest_line_ = reader_.line();
      }
      corners.push_back(static_cast<Index>(index));
    }
  }

  PolygonText& target_;
  TextReader reader_;
  std::int64_t largest_ = -1;
  std::int64_t largest_line_ = 1;
};

PolygonText::PolygonText(const std::string& path) {
  const auto extension = extension_of(path);
  if (extension != "obj" && extension != "off") {
    throw OptionError(path + ": expected a file ending in .obj or .off");
  }
  const bool is_obj = extension == "obj";
  soup_ = is_obj ? read_obj(path) : read_off(path);
  text_ = read_file(path);
  Scanner scanner(path, *this, {'#', is_obj});
  is_obj ? scanner.scan_obj() : scanner.scan_off();
  if (normals_.empty()) return;

  rest_normals_ = compute_normals(soup_.points);
  num_loose_normals_ = static_cast<Index>(std::count_if(rest_normals_.begin(), rest_normals_.end(),
                                                        [](const auto& n) { return n.isZero(0); }));
}

std::vector<Vector<3>> PolygonText::compute_normals(const std::vector<Vector<3>>& points) const {
  std::vector<Vector<3>> normals(normals_.size(), Vector<3>::Zero());
  for (std::size_t f = 0; f < soup_.polygons.size(); ++f) {
    const Vector<3> area = area_vector(soup_.polygons[f], points);
    for (const Index normal : corner_normals_[f]) {
      if (normal >= 0) normals[normal] += area;
    }
  }
  return normals;
}

template <int Dim>
void PolygonText::write(std::ostream& out, const PointList<Dim>& points) const {
  if (points.cols() != static_cast<Eigen::Index>(soup_.points.size())) {
    throw InputError("the file has " + std::to_string(soup_.points.size()) +
                     " vertices, but there are " + std::to_string(points.cols()) + " points");
  }
  std::vector<Vector<3>> normals;
  if constexpr (Dim == 3) {
    std::vector<Vector<3>> moved(soup_.points.size());
    for (std::size_t v = 0; v < moved.size(); ++v) moved[v] = points.col(v);
    if (!normals_.empty()) normals = compute_normals(moved);
  }

  TextWriter writer(out);
  std::size_t done = 0;
  const auto replace = [&](const Span& span, double value) {
    writer << std::string_view(text_).substr(done, span.begin - done);
    if (span.size == 0) writer << " ";
    writer << value;
    done = span.begin + span.size;
  };
  for (const Triple& triple : triples_) {
    if (!triple.is_normal) {
      for (int d = 0; d < Dim; ++d) replace(triple.spans[d], points(d, triple.index));
    } else if (Dim == 3) {
      const Vector<3>& before = rest_normals_[triple.index];
      const Vector<3>& after = normals[triple.index];
      if (before.isZero(0) || after.isZero(0)) continue;
      const Vector<3> normal =
          Eigen::Quaterniond::FromTwoVectors(before, after) * normals_[triple.index];
      for (int d = 0; d < 3; ++d) replace(triple.spans[d], normal[d]);
    }
  }
  writer << std::string_view(text_).substr(done);
  writer.flush();
}

template void PolygonText::write<2>(std::ostream&, const PointList<2>&) const;
template void PolygonText::write<3>(std::ostream&, const PointList<3>&) const;

}  // namespace flbc::io
