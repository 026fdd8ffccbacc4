// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/io/cut_polygon.h"

#include <numeric>

#include "model/polygon_triangles.h"

namespace flbc::io {

FacetList<3> cut_polygon(const std::vector<Vector<3>>& corners) {
  PolygonCutter::Polygon polygon(corners.size());
  std::iota(polygon.begin(), polygon.end(), 0);
  const auto triangles = PolygonCutter(corners, polygon).cut();
  FacetList<3> result(3, triangles.size());
  for (std::size_t t = 0; t < triangles.size(); ++t) result.col(t) = triangles[t];
  return result;
}

}  // namespace flbc::io
