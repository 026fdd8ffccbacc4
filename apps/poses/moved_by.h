// SPDX-License-Identifier: BSD-3-Clause
// How a cage moves a model, written as weighted sums of its control points and some further
// vectors.
#pragma once

#include <functional>

#include "flbc/bounding_box.h"
#include "flbc/cage.h"
#include "flbc/sparse_weights.h"

namespace flbc::app {

template <int Dim>
struct MovedBy {
  SparseWeights weights{};  // of n control points and k further vectors, P points
  // From the control points of a pose, Dim x n, to these vectors, Dim x (n + k); empty if k is 0.
  std::function<PointList<Dim>(const PointList<Dim>&)> vectors{};
  PointList<Dim> offsets{};  // Dim x P, what is added to the sums; no columns if all are zero

  // The points in a pose. \param pose  Dim x n
  PointList<Dim> at(const PointList<Dim>& pose) const;
};

// A point x moves to x + sum_i w_i (c'_i - c_i). Where the weights reproduce x up to the
// tolerance, this is sum_i w_i c'_i. Elsewhere the offset is what the weights do not reproduce:
// points outside the cage, and all by weights of method bbw.
// \param rest  Dim x n; no column if it is not known. Then only points without weights are
// considered, which stay where they are
// \param points  Dim x P
// \param tolerance  relative to the size of the cage
template <int Dim>
MovedBy<Dim> by_weights(const SparseWeights& weights, const PointList<Dim>& rest,
                        const PointList<Dim>& points, double tolerance = kBoundaryTolerance);

// Green coordinates: the normals of the facets join.
// \throws InputError if a point is outside the cage
template <int Dim>
MovedBy<Dim> by_green_coordinates(const Cage<Dim>& cage, const PointList<Dim>& points);

}  // namespace flbc::app
