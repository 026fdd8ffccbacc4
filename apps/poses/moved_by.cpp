// SPDX-License-Identifier: BSD-3-Clause
#include "poses/moved_by.h"

#include <utility>

#include "flbc/bounding_box.h"
#include "flbc/deform.h"
#include "flbc/green.h"
#include "instantiate.h"

namespace flbc::app {

template <int Dim>
PointList<Dim> MovedBy<Dim>::at(const PointList<Dim>& pose) const {
  PointList<Dim> moved = deform<Dim>(weights, vectors ? vectors(pose) : pose);
  if (offsets.cols() > 0) moved += offsets;
  return moved;
}

template <int Dim>
MovedBy<Dim> by_weights(const SparseWeights& weights, const PointList<Dim>& rest,
                        const PointList<Dim>& points, double tolerance) {
  PointList<Dim> missing = PointList<Dim>::Zero(Dim, points.cols());
  const bool is_known = rest.cols() > 0;
  if (is_known) {
    missing = points - deform<Dim>(weights, rest);
    const double least = tolerance * bounding_box_diagonal(rest);
    for (auto part : missing.colwise()) {
      if (part.norm() <= least) part.setZero();
    }
  }
  for (Index p = 0; p < weights.num_points(); ++p) {
    if (!weights.has_weights(p)) missing.col(p) = points.col(p);
  }
  if (missing.isZero(0)) missing.resize(Dim, 0);
  return {weights, {}, std::move(missing)};
}

template <int Dim>
MovedBy<Dim> by_green_coordinates(const Cage<Dim>& cage, const PointList<Dim>& points) {
  return {SparseWeights(green_coordinates(cage, points)),
          [cage](const PointList<Dim>& pose) { return control_points_and_normals(cage, pose); }};
}

template struct MovedBy<2>;
template struct MovedBy<3>;
FLBC_INSTANTIATE_FUNCTION(by_weights)
FLBC_INSTANTIATE_FUNCTION(by_green_coordinates)

}  // namespace flbc::app
