// SPDX-License-Identifier: BSD-3-Clause
// A column of points that passes through one side of a box, bound by multilinear weights.
#pragma once

#include "flbc/binding.h"
#include "support/code_cages.h"

namespace flbc::testing {

//! The box [-1, 1]^Dim. Points are a grid around the x axis, from x = -1.5 to 0.9; those with
//! x < -1 have no weights. At x = -1 + 2 m, the control points with x = 1 have the sum m.
template <int Dim>
Binding<Dim> box_column() {
  constexpr Index kLength = 49, kAcross = 3;
  const auto cage = box_cage<Dim>(1);
  const Index layer = Dim == 2 ? kAcross : kAcross * kAcross;
  PointList<Dim> points(Dim, kLength * layer);
  WeightMatrix weights = WeightMatrix::Zero(cage.size(), points.cols());
  EdgeList edges;
  for (Index p = 0; p < points.cols(); ++p) {
    const Index at[3] = {p / layer, p % kAcross, p % layer / kAcross};
    points(0, p) = -1.475 + 0.05 * at[0];
    for (int d = 1; d < Dim; ++d) points(d, p) = 0.3 * (at[d] - 1);
    if (at[0] + 1 < kLength) edges.ends.push_back({p, p + layer});
    if (points(0, p) < -1) continue;
    for (Index i = 0; i < cage.size(); ++i) {
      weights(i, p) =
          (1 + (cage.points.col(i).array() * points.col(p).array())).prod() / (1 << Dim);
    }
  }
  return bound_by<Dim>(cage, points, weights, edges);
}

//! The rest cage with the side x = 1 moved.
template <int Dim>
PointList<Dim> with_moved_side(const Cage<Dim>& cage) {
  PointList<Dim> pose = cage.points;
  for (Index i = 0; i < cage.size(); ++i) {
    if (pose(0, i) > 0) pose.col(i) += Vector<Dim>::LinSpaced(0.2, 0.5) * (1 + 0.1 * i);
  }
  return pose;
}

}  // namespace flbc::testing
