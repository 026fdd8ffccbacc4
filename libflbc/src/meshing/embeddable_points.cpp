// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/meshing.h"

#include "base/instantiate.h"
#include "base/parallel.h"
#include "cage/close_points.h"
#include "cage/point_in_cage.h"
#include "flbc/bounding_box.h"
#include "meshing/meshing_common.h"

namespace flbc {

template <int Dim>
EmbeddablePoints<Dim> embeddable_points(const Cage<Dim>& cage, const PointList<Dim>& points) {
  const double tolerance = kPointTolerance * bounding_box_diagonal<Dim>(cage.points);
  const auto num_points = static_cast<Index>(points.cols());
  const CageLocator<Dim> locator(cage, tolerance);
  std::vector<char> is_inside(std::size_t(num_points), 0);  // written concurrently
  parallel_for(num_points, [&](Index p) {
    is_inside[p] = locator.locate(points.col(p)) == Containment::kInside;
  });
  // Each coincident point is paired with an earlier one, so the first one represents all.
  std::vector<Index> same(std::size_t(num_points), -1);
  for (const auto& [first, second] :
       find_close_pairs<Dim>(points, tolerance, std::size_t(num_points))) {
    same[second] = first;
  }

  EmbeddablePoints<Dim> result;
  result.points.resize(Dim, num_points);
  result.number.assign(std::size_t(num_points), -1);
  Index count = 0;
  for (Index p = 0; p < num_points; ++p) {
    if (!is_inside[p]) continue;
    if (same[p] >= 0) {
      result.number[p] = result.number[same[p]];  // -1 if that one is on the cage
      continue;
    }
    result.points.col(count) = points.col(p);
    result.number[p] = count++;
  }
  result.points.conservativeResize(Dim, count);
  return result;
}

FLBC_INSTANTIATE_FUNCTION(embeddable_points)

}  // namespace flbc
