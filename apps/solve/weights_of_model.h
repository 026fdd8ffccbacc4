// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Whether weights belong to a model and a cage.
#pragma once

#include <string>

#include "flbc/cage.h"
#include "flbc/sparse_weights.h"

namespace flbc::app {

//! The files that should belong together, for messages.
struct WeightFiles {
  std::string weights;
  std::string cage;
  std::string model;
};

//! \throws InputError naming both files if there are not as many rows as control points, or not as
//! many columns as points
void check_sizes(const SparseWeights& weights, Eigen::Index num_control_points,
                 Eigen::Index num_points, const WeightFiles& files);

//! The number of points without weights, which do not move.
Index count_without_weights(const SparseWeights& weights);

//! Checks sizes, and where the weights put the points.
//! Vertices without weights are right, and vertices outside that follow the nearest point of the
//! cage.
//! \param rest  n control points; without facets no vertex counts as outside
//! \param points  Dim x P, of the model
//! \throws InputError naming the worst vertex if the weights put one elsewhere by more than 1e-6 of
//! the cage size: they are for another model, or for another cage
template <int Dim>
void check_reproduction(const SparseWeights& weights, const Cage<Dim>& rest,
                        const PointList<Dim>& points, const WeightFiles& files);

}  // namespace flbc::app
