// SPDX-License-Identifier: BSD-3-Clause
// Ways in which a cage moves a model other than by weighted sums of its control points, written as
// such sums: some further vectors join the control points.
#pragma once

#include <functional>

#include "flbc/cage.h"
#include "flbc/sparse_weights.h"

namespace flbc::app {

template <int Dim>
struct MovedBy {
  SparseWeights weights{};  //!< of n control points and k further vectors, P points
  //! From the control points of a pose, Dim x n, to these vectors, Dim x (n + k).
  std::function<PointList<Dim>(const PointList<Dim>&)> vectors{};
};

//! The control points themselves.
template <int Dim>
MovedBy<Dim> by_control_points(SparseWeights weights);

//! Green coordinates: the normals of the facets join.
//! \throws InputError if a point is outside the cage
template <int Dim>
MovedBy<Dim> by_green_coordinates(const Cage<Dim>& cage, const PointList<Dim>& points);

//! Displacements of the control points that are added to the points, for weights that do not
//! reproduce them. The unit vectors join; their weights are what the weights do not reproduce.
//! \param rest  Dim x n \param points  Dim x P
template <int Dim>
MovedBy<Dim> by_displacements(const SparseWeights& weights, const PointList<Dim>& rest,
                              const PointList<Dim>& points);

}  // namespace flbc::app
