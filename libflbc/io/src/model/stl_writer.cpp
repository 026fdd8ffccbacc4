// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <cstring>
#include <string>
#include <string_view>

#include <Eigen/Geometry>

#include "flbc/errors.h"
#include "flbc/io/cage_io.h"
#include "model/model_scan.h"
#include "text/text_writer.h"

namespace flbc::io {
namespace {

// A normal and three corners.
using Triangle = Eigen::Matrix<float, 3, 4>;

// Polygons cut into triangles, in single precision.
std::vector<Triangle> triangles_of(const PolygonSoup& soup) {
  std::vector<Triangle> triangles;
  for (const auto& polygon : soup.polygons) {
    std::vector<Vector<3>> corners;
    corners.reserve(polygon.size());
    for (const Index vertex : polygon) corners.push_back(soup.points[vertex]);
    const auto parts = cut_polygon(corners);
    for (const auto& part : parts.colwise()) {
      const Vector<3>&a = corners[part[0]], &b = corners[part[1]], &c = corners[part[2]];
      Vector<3> normal = (b - a).cross(c - a);
      normal.stableNormalize();
      triangles.emplace_back();
      triangles.back() << normal.cast<float>(), a.cast<float>(), b.cast<float>(), c.cast<float>();
      if (triangles.back().allFinite()) continue;
      throw InputError("polygon " + std::to_string(&polygon - soup.polygons.data()) +
                       " has a coordinate too large for the single precision of .stl files");
    }
  }
  return triangles;
}

template <class T>
void put(TextWriter& writer, const T* values, std::size_t count) {
  char bytes[sizeof(Triangle)];
  std::memcpy(bytes, values, count * sizeof(T));
  writer << std::string_view(bytes, count * sizeof(T));
}

}  // namespace

void write_stl(std::ostream& out, const Model& model) {
  const auto triangles = triangles_of(model.soup);
  TextWriter writer(out);
  const auto count = static_cast<std::uint32_t>(triangles.size());
  const std::uint16_t no_attributes = 0;
  writer << std::string(80, '\0');
  put(writer, &count, 1);
  for (const auto& triangle : triangles) {
    put(writer, triangle.data(), 12);
    put(writer, &no_attributes, 1);
  }
  writer.flush();
}

}  // namespace flbc::io
