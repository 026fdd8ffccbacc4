// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/io/obj_attributes.h"

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <limits>
#include <string_view>

#include "flbc/io/files.h"
#include "text/text_reader.h"

namespace flbc::io {
namespace {

// The second and third number of "v/vt/vn"; 0 stands for one that is missing.
struct Numbers {
  std::int64_t texture_coordinate = 0;
  std::int64_t normal = 0;
};

Numbers numbers_of_corner(std::string_view corner) {
  Numbers numbers;
  for (auto* const number : {&numbers.texture_coordinate, &numbers.normal}) {
    const std::size_t slash = corner.find('/');
    if (slash == std::string_view::npos) break;
    corner.remove_prefix(slash + 1);
    std::from_chars(corner.data(), corner.data() + corner.size(), *number);
  }
  return numbers;
}

// References to a list that may stand after them in the file.
class References {
 public:
  explicit References(const char* things) : things_(things) {}

  // \param number  from 1, or backwards from the latest if negative \return from 0, -1 = none
  Index resolve(const TextReader& reader, std::int64_t number, std::size_t seen) {
    const std::int64_t index = number >= 0 ? number - 1 : static_cast<std::int64_t>(seen) + number;
    if ((number < 0 && index < 0) || index >= std::numeric_limits<Index>::max()) {
      reader.fail("the index " + std::to_string(number) + " is out of range; there are " +
                  std::to_string(seen) + " " + things_ + " before this line");
    }
    if (index > largest_) {
      largest_ = index;
      line_ = reader.line();
    }
    return static_cast<Index>(index);
  }

  void check(const TextReader& reader, std::size_t count) const {
    if (largest_ < static_cast<std::int64_t>(count)) return;
    reader.fail_at(line_, out_of_range_message(largest_ + 1, things_, 1, count));
  }

 private:
  const char* things_;
  std::int64_t largest_ = -1;
  std::int64_t line_ = 1;
};

template <int Dim>
PointList<Dim> to_matrix(const std::vector<Vector<Dim>>& columns) {
  PointList<Dim> matrix(Dim, columns.size());
  for (std::size_t k = 0; k < columns.size(); ++k) matrix.col(k) = columns[k];
  return matrix;
}

class AttributeReader {
 public:
  explicit AttributeReader(const std::string& path) : reader_(path, read_file(path), {'#', true}) {}

  SurfaceAttributes read(const PolygonSoup& soup) {
    while (reader_.next_line()) {
      const std::string_view keyword = reader_.word();
      if (keyword == "v") {
        read_vertex();
      } else if (keyword == "vt") {
        read_texture_coordinate();
      } else if (keyword == "vn") {
        normals_.push_back(reader_.point());
      } else if (keyword == "f") {
        read_corners();
      }
    }
    to_texture_coordinates_.check(reader_, texture_coordinates_.size());
    to_normals_.check(reader_, normals_.size());
    require_same_elements(soup);
    return {to_matrix<2>(texture_coordinates_), to_matrix<3>(normals_), colors(),
            std::move(corners_)};
  }

 private:
  // Coordinates, of which planar curves lack z, maybe a weight, or a colour with or without alpha.
  void read_vertex() {
    std::vector<double> numbers;
    while (reader_.has_word()) numbers.push_back(reader_.number());
    ++num_points_;
    if (numbers.size() == 6 || numbers.size() == 7) {
      colors_.emplace_back(numbers[3], numbers[4], numbers[5]);
    }
  }

  void read_texture_coordinate() {
    const double u = reader_.number();
    texture_coordinates_.emplace_back(u, reader_.has_word() ? reader_.number() : 0);
  }

  void read_corners() {
    auto& corners = corners_.emplace_back();
    while (reader_.has_word()) {
      const Numbers numbers = numbers_of_corner(reader_.word());
      corners.push_back({to_texture_coordinates_.resolve(reader_, numbers.texture_coordinate,
                                                         texture_coordinates_.size()),
                         to_normals_.resolve(reader_, numbers.normal, normals_.size())});
    }
  }

  void require_same_elements(const PolygonSoup& soup) const {
    const bool same =
        num_points_ == soup.points.size() &&
        std::equal(corners_.begin(), corners_.end(), soup.polygons.begin(), soup.polygons.end(),
                   [](const auto& a, const auto& b) { return a.size() == b.size(); });
    if (!same) {
      reader_.fail(
          "a texture coordinate (\"vt\") or normal (\"vn\") is continued on another line; "
          "it must be on one");
    }
  }

  // Numbers beyond [0, 1] mean something else.
  PointList<3> colors() const {
    const bool are_colors = colors_.size() == num_points_ &&
                            std::all_of(colors_.begin(), colors_.end(), [](const Vector<3>& color) {
                              return color.minCoeff() >= 0 && color.maxCoeff() <= 1;
                            });
    return are_colors ? to_matrix<3>(colors_) : PointList<3>();
  }

  TextReader reader_;
  std::size_t num_points_ = 0;
  std::vector<Vector<2>> texture_coordinates_;
  std::vector<Vector<3>> normals_;
  std::vector<Vector<3>> colors_;
  std::vector<std::vector<CornerReferences>> corners_;
  References to_texture_coordinates_{"texture coordinates"};
  References to_normals_{"normals"};
};

}  // namespace

SurfaceAttributes read_obj_attributes(const std::string& path, const PolygonSoup& soup) {
  return AttributeReader(path).read(soup);
}

}  // namespace flbc::io
