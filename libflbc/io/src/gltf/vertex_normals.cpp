// SPDX-License-Identifier: BSD-3-Clause
#include "gltf/vertex_normals.h"

#include <cmath>

#include <Eigen/Geometry>

namespace flbc::gltf {

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

}  // namespace flbc::gltf
