// SPDX-License-Identifier: BSD-3-Clause
#include <vector>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/convex_hull_3.h>

#include "caging/cage_steps.h"
#include "caging/cgal/to_cage.h"

namespace flbc {

Cage<3> convex_hull(const PointList<3>& points) {
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  std::vector<Kernel::Point_3> all;
  for (Index v = 0; v < static_cast<Index>(points.cols()); ++v) {
    all.emplace_back(points(0, v), points(1, v), points(2, v));
  }
  CGAL::Surface_mesh<Kernel::Point_3> hull;
  CGAL::convex_hull_3(all.begin(), all.end(), hull);
  return to_cage(hull);
}

}  // namespace flbc
