// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Few influences per point: weights for engines that read at most K of them, and small files.
#pragma once

#include <functional>
#include <limits>

#include "flbc/sparse_weights.h"
#include "flbc/types.h"

namespace flbc {

//! Limits on the number and size of a point's weights.
struct SparsifyOptions {
  //! Most influences per point, Dim + 1 or more: fewer cannot reproduce a point inside the hull.
  Index max_influences = std::numeric_limits<Index>::max();
  //! In [0, 1). Weights below it are dropped first, as far as the rest still reproduces the point.
  //! The weights that remain are moved for that and may come to lie below it.
  double threshold = 0;
  //! Called by the calling thread now and then with the part in [0, 1] that is done; must not throw.
  std::function<void(double done)> progress{};
};

//! Checks options.
//! \param options  any
//! \throws OptionError naming the option that is out of range
template <int Dim>
void validate(const SparsifyOptions& options);

//! Replaces every column by one with at most `max_influences` weights other than 0, with w >= 0,
//! sum w = 1 and sum w c = x. Sum and reproduction hold to 1e-13, the latter relative to the size
//! of the control points. |w - given|^2 is the expected squared error of the point under random
//! independent displacements of the control points; it is the least for the influences kept. These
//! are chosen by removing one after the other, each time the one that costs least, and by exchange
//! with others that were given 1e-3 or more; mostly, though not always, that is the best choice of
//! all. Columns that are like that already stay; without options the result is that of
//! project_non_negative. The given weights may be negative and need not reproduce.
//! \param control_points  Dim x n, finite
//! \param points  Dim x P, inside the convex hull of the control points, in their units
//! \param weights  n x P, finite
//! \param options  as validate() demands
//! \return n x P
//! \throws OptionError as validate(), InputError if sizes do not fit, if a number is not finite or
//! if a point lies outside the convex hull of the control points, naming the first such point
template <int Dim>
WeightMatrix sparsify(const PointList<Dim>& control_points, const PointList<Dim>& points,
                      const WeightMatrix& weights, const SparsifyOptions& options);

//! The same for weights without their zeros.
template <int Dim>
SparseWeights sparsify(const PointList<Dim>& control_points, const PointList<Dim>& points,
                       const SparseWeights& weights, const SparsifyOptions& options);

}  // namespace flbc
