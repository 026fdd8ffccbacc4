// SPDX-License-Identifier: BSD-3-Clause
#include "caging/cage_steps.h"

#include <vector>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/convex_hull_3.h>

namespace flbc {

double hull_volume(const PointList<3>& points) {
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  std::vector<Kernel::Point_3> all;
  for (Index v = 0; v < static_cast<Index>(points.cols()); ++v) {
    all.emplace_back(points(0, v), points(1, v), points(2, v));
  }
  CGAL::Surface_mesh<Kernel::Point_3> hull;
  CGAL::convex_hull_3(all.begin(), all.end(), hull);
  double sum = 0;
  for (const auto face : hull.faces()) {
    Eigen::Matrix3d corners;
    int k = 0;
    for (const auto vertex : vertices_around_face(hull.halfedge(face), hull)) {
      const auto& p = hull.point(vertex);
      corners.col(k++) << p.x(), p.y(), p.z();
    }
    corners.colwise() -= points.col(0).eval();
    sum += corners.determinant() / 6;
  }
  return sum;
}

}  // namespace flbc
