// SPDX-License-Identifier: BSD-3-Clause
// What the parts of check_weights() share.
#pragma once

#include <vector>

#include "flbc/check.h"

namespace flbc {

constexpr double kInfluence = 1e-4;  // |w_i| above it counts as influence, as in measure_quality()

//! Takes the value if it is the first or larger; the first of equal ones stays.
template <int Dim>
void keep_larger(Extreme<Dim>& best, const Extreme<Dim>& other) {
  if (other.point >= 0 && (best.point < 0 || other.value > best.value)) best = other;
}

template <int Dim>
void keep_smaller(Extreme<Dim>& best, const Extreme<Dim>& other) {
  if (other.point >= 0 && (best.point < 0 || other.value < best.value)) best = other;
}

//! A point on the cage and the weights that it must have.
template <int Dim>
struct KnownWeights {
  Index point;
  Eigen::Matrix<Index, Dim, 1> control_points;
  Vector<Dim> values;          //!< of these; the others' are 0
  Index coinciding_with = -1;  //!< the control point that lies there, if one does
};

//! Everything but what needs a mesh. The sizes belong together.
template <int Dim>
WeightCheck<Dim> check_at_points(const Cage<Dim>& cage, const PointList<Dim>& points,
                                 const WeightMatrix& weights,
                                 const std::vector<KnownWeights<Dim>>& known);

//! \throws InputError if the sizes do not belong together
template <int Dim>
void check_sizes(const Cage<Dim>& cage, const PointList<Dim>& points, const WeightMatrix& weights);

}  // namespace flbc
