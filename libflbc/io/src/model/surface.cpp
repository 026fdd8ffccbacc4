// SPDX-License-Identifier: BSD-3-Clause
#include "model/surface.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/Geometry>

#include "base/first_equals.h"
#include "flbc/errors.h"
#include "flbc/io/cage_io.h"
#include "model/srgb.h"

namespace flbc::gltf {
namespace {

// The angle-weighted mean of the triangle normals around each vertex, which does not depend on the
// triangulation of polygons. Copies of a point have the same normal.
// \param sources  per vertex, the point of which it is a copy \param triangles  3 x T, of vertices
// \return 3 x number of vertices, of length 1; (0, 0, 1) if all its triangles are degenerate
PointList<3> vertex_normals(const std::vector<Vector<3>>& points, const std::vector<Index>& sources,
                            const FacetList<3>& triangles) {
  PointList<3> sums = PointList<3>::Zero(3, points.size());
  for (const auto& triangle : triangles.colwise()) {
    for (int k = 0; k < 3; ++k) {
      const Index point = sources[triangle[k]];
      // Normalized, so tiny triangles do not underflow.
      const Vector<3> next =
          (points[sources[triangle[(k + 1) % 3]]] - points[point]).stableNormalized();
      const Vector<3> last =
          (points[sources[triangle[(k + 2) % 3]]] - points[point]).stableNormalized();
      const Vector<3> normal = next.cross(last);
      const double sine = normal.norm();
      if (sine > 0) sums.col(point) += std::atan2(sine, next.dot(last)) / sine * normal;
    }
  }
  PointList<3> normals(3, sources.size());
  for (std::size_t v = 0; v < sources.size(); ++v) {
    const Vector<3> sum = sums.col(sources[v]);
    normals.col(v) = sum.isZero(0) ? Vector<3>::UnitZ() : sum.stableNormalized();
  }
  return normals;
}

// A corner; two corners with the same three numbers share a vertex.
struct Corner {
  Index point;
  Index texture_coordinate;
  Index normal;

  std::array<Index, 3> key() const { return {point, texture_coordinate, normal}; }
  bool operator<(const Corner& other) const { return key() < other.key(); }
  bool operator==(const Corner& other) const { return key() == other.key(); }
};
using Corners = std::vector<Corner>;  // three per triangle

// Normalized; zero if there is none.
PointList<3> unit(const PointList<3>& normals) {
  PointList<3> result = normals;
  for (auto normal : result.colwise()) normal.stableNormalize();
  return result;
}

// The attributes of all corners. Programs write equal values many times, which make no seam.
class CornerTable {
 public:
  CornerTable(const io::SurfaceAttributes& attributes, const PointList<3>& normals)
      : attributes_(attributes),
        normals_(normals),
        first_texture_coordinate_(first_equals(attributes.texture_coordinates)),
        first_normal_(first_equals(normals)) {}

  Corner corner(std::size_t polygon, Index k, Index point) const {
    Corner result{point, -1, -1};
    if (attributes_.corners.empty()) return result;
    const auto& references = attributes_.corners[polygon][k];
    if (references.texture_coordinate >= 0) {
      result.texture_coordinate = first_texture_coordinate_[references.texture_coordinate];
    }
    if (references.normal >= 0 && !normals_.col(references.normal).isZero(0)) {
      result.normal = first_normal_[references.normal];
    }
    return result;
  }

 private:
  const io::SurfaceAttributes& attributes_;
  const PointList<3>& normals_;
  std::vector<Index> first_texture_coordinate_;
  std::vector<Index> first_normal_;
};

void append_triangles(const io::PolygonSoup& soup, std::size_t polygon, const CornerTable& table,
                      Corners& corners) {
  const auto& points = soup.polygons[polygon];
  std::vector<Vector<3>> places;
  places.reserve(points.size());
  for (const Index point : points) places.push_back(soup.points[point]);
  const auto triangles = io::cut_polygon(places);
  for (const auto& triangle : triangles.colwise()) {
    const Index a = points[triangle[0]], b = points[triangle[1]], c = points[triangle[2]];
    if (a == b || b == c || c == a) continue;
    for (const Index k : triangle) corners.push_back(table.corner(polygon, k, points[k]));
  }
}

void turn_counterclockwise(const io::PolygonSoup& soup, Corners& corners) {
  for (std::size_t t = 0; t < corners.size(); t += 3) {
    const Vector<3>& a = soup.points[corners[t].point];
    const Vector<3> ab = soup.points[corners[t + 1].point] - a;
    const Vector<3> ac = soup.points[corners[t + 2].point] - a;
    if (ab.x() * ac.y() < ab.y() * ac.x()) std::swap(corners[t + 1], corners[t + 2]);
  }
}

// The vertices, in the order of the model vertices, and the corners of the triangles.
Surface index_corners(const Corners& corners, Corners& vertices) {
  vertices = corners;
  std::sort(vertices.begin(), vertices.end());
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  Surface surface;
  for (const Corner& vertex : vertices) surface.sources.push_back(vertex.point);
  surface.triangles.resize(3, corners.size() / 3);
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const auto found = std::lower_bound(vertices.begin(), vertices.end(), corners[k]);
    surface.triangles(k % 3, k / 3) = static_cast<Index>(found - vertices.begin());
  }
  return surface;
}

void add_texture_and_colors(const io::SurfaceAttributes& attributes, const Corners& vertices,
                            Surface& surface) {
  const bool has_texture = std::any_of(vertices.begin(), vertices.end(), [](const Corner& vertex) {
    return vertex.texture_coordinate >= 0;
  });
  if (has_texture) surface.texture_coordinates.setZero(2, vertices.size());
  for (std::size_t v = 0; has_texture && v < vertices.size(); ++v) {
    const Index k = vertices[v].texture_coordinate;
    if (k < 0) continue;
    const auto place = attributes.texture_coordinates.col(k);
    surface.texture_coordinates.col(v) << place[0], 1 - place[1];
  }
  if (attributes.colors.cols() > 0) {
    surface.colors = attributes.colors(Eigen::all, surface.sources).unaryExpr(&io::to_linear);
  }
}

}  // namespace

template <int Dim>
Surface surface_of_model(const io::Model& model) {
  const auto& soup = model.soup;
  const auto& attributes = model.attributes;
  // Planar models get constant normals.
  PointList<3> normals = unit(attributes.normals);
  if (Dim == 2) normals.setZero();
  const CornerTable table(attributes, normals);
  Corners corners;
  std::vector<Index> triangle_materials;
  for (std::size_t f = 0; f < soup.polygons.size(); ++f) {
    append_triangles(soup, f, table, corners);
    if (!model.polygon_materials.empty()) {
      triangle_materials.resize(corners.size() / 3, model.polygon_materials[f]);
    }
  }
  if (corners.empty()) {
    throw InputError("its " + std::to_string(soup.polygons.size()) +
                     " polygons contain no triangle, but glTF and USD need a surface");
  }
  if (Dim == 2) turn_counterclockwise(soup, corners);

  Corners vertices;
  Surface surface = index_corners(corners, vertices);
  surface.triangle_materials = std::move(triangle_materials);
  surface.materials = model.materials;
  surface.missing_files = model.missing_files;
  surface.gltf = model.gltf;
  add_texture_and_colors(attributes, vertices, surface);
  if (Dim == 2) {
    surface.normals = Vector<3>::UnitZ().replicate(1, vertices.size());
    return surface;
  }
  surface.normals = vertex_normals(soup.points, surface.sources, surface.triangles);
  for (std::size_t v = 0; v < vertices.size(); ++v) {
    if (vertices[v].normal >= 0) surface.normals.col(v) = normals.col(vertices[v].normal);
  }
  return surface;
}

FacetList<3> triangles_of_points(const Surface& surface) {
  FacetList<3> triangles = surface.triangles;
  for (auto& vertex : triangles.reshaped()) vertex = surface.sources[vertex];
  return triangles;
}

template Surface surface_of_model<2>(const io::Model&);
template Surface surface_of_model<3>(const io::Model&);

}  // namespace flbc::gltf
