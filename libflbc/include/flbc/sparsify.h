// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Few influences per point: weights for engines that read at most K of them, and small files.
#pragma once

#include <functional>
#include <limits>
#include <vector>

#include "flbc/domain_mesh.h"
#include "flbc/sparse_weights.h"
#include "flbc/types.h"

namespace flbc {

//! Limits on the number and size of a point's weights.
struct SparsifyOptions {
  //! Maximum influences per point, >= Dim + 1: fewer cannot reproduce a point inside the hull.
  Index max_influences = std::numeric_limits<Index>::max();
  //! In [0, 1). Weights below it are dropped first, as far as the rest still reproduces the point.
  //! The weights that remain are moved for that and may come to lie below it.
  double threshold = 0;
  //! Called by the calling thread with the progress in [0, 1]; must not throw.
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
//! independent displacements of the control points; it is the least for the influences kept. They
//! are chosen by removing the cheapest one repeatedly, and by exchange with others that were given
//! 1e-3 or more. This is usually, but not always, the best choice. Columns that satisfy all this
//! are unchanged. Without options the result is that of project_non_negative. The given weights may
//! be negative and need not reproduce.
//! \param control_points  Dim x n, finite
//! \param points  Dim x P, inside the convex hull of the control points, in their units
//! \param weights  n x P, finite
//! \param options  as validate() demands
//! \tparam Weights  WeightMatrix or SparseWeights
//! \return n x P
//! \throws OptionError as validate(), InputError if sizes do not fit, if a number is not finite or
//! if a point lies outside the convex hull of the control points, naming the first such point
template <int Dim, class Weights>
Weights sparsify(const PointList<Dim>& control_points, const PointList<Dim>& points,
                 const Weights& weights, const SparsifyOptions& options);

//! Makes weights sparse as sparsify() does, under the same constraints and with the same exactness,
//! but not point by point: what becomes least is the error of the differences along the edges, so
//! that no seams appear where neighbors keep different influences (after Landreneau and Schaefer,
//! "Poisson-Based Weight Reduction of Animated Meshes", 2010; there influences are dropped in the
//! order of their cost). With d_a the new less the given weights of point a and C_p pose p, it is
//!
//!     mean_p ( sum_ab k_ab |C_p (d_a - d_b)|^2 + sum_a m_a / r^2 |C_p d_a|^2 )
//!
//! over edges ab and points a, with m_a = sum_b k_ab |x_a - x_b|^2 / 2 and r a twentieth of the
//! size of the points, or five edges of mean length if that is more: the second term is small and
//! keeps points in their places. To the mean over the given poses a tenth of what a pose of
//! independent_poses() and one of smooth_poses() cost together on average is added, for the control
//! points that the given ones do not move; without given poses all of that is what counts.
//!
//! Found by block coordinate descent: point by point, a row's weights are exchanged for the best
//! ones while its neighbors are fixed. The result is a local minimum, and not above what
//! sparsify() gives. Points without edges get the weights of sparsify(), points given with at most
//! Dim influences keep them, since these lie on the cage and follow its facet; points that coincide
//! and have the same weights are given the same. The same result for any number of threads.
//! \param control_points  Dim x n, finite
//! \param points  Dim x P, inside the convex hull of the control points, in their units
//! \param edges  between the points, weights of any unit
//! \param weights  n x P, as for sparsify()
//! \param poses  Dim x n each, displaced control points, may be empty
//! \param options  as for sparsify()
//! \return n x P
//! \throws OptionError and InputError as sparsify(), InputError also for edges and poses that do
//! not fit
template <int Dim>
WeightMatrix reduce_by_poisson(const PointList<Dim>& control_points, const PointList<Dim>& points,
                               const EdgeList& edges, const WeightMatrix& weights,
                               const std::vector<PointList<Dim>>& poses,
                               const SparsifyOptions& options);

//! The energy that reduce_by_poisson() minimizes, for any weights, with displacements in units of a
//! tenth of the cage's size.
//! \param control_points  Dim x n, finite
//! \param points  Dim x P
//! \param edges  between the points
//! \param before  n x P, the weights given
//! \param after  n x P, the weights to judge
//! \param poses  Dim x n each, may be empty
//! \return >= 0
//! \throws InputError if weights, edges or poses do not fit
template <int Dim>
double poisson_cost(const PointList<Dim>& control_points, const PointList<Dim>& points,
                    const EdgeList& edges, const WeightMatrix& before, const WeightMatrix& after,
                    const std::vector<PointList<Dim>>& poses);

}  // namespace flbc
