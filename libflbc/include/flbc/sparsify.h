// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Limits influences per point, for engines with a maximum number and for small files.
#pragma once

#include <functional>
#include <limits>
#include <vector>

#include "flbc/domain_mesh.h"
#include "flbc/masks.h"
#include "flbc/sparse_weights.h"
#include "flbc/types.h"

namespace flbc {

//! Limits on the number and size of the weights of a point.
struct SparsifyOptions {
  //! Maximum influences per point, >= Dim + 1: fewer cannot reproduce a point inside the hull.
  Index max_influences = (std::numeric_limits<Index>::max)();
  //! Threshold in [0, 1). Smaller weights are dropped first, if the rest can still reproduce the
  //! point. The adjusted remaining weights may end up below the threshold.
  double threshold = 0;
  //! Called on the calling thread with the progress in [0, 1]. What it throws leaves the
  //! reduction.
  std::function<void(double done)> progress{};
  std::vector<Mask> masks{};  //!< of the points; masked weights become exactly 0
  //! Of the points, from an earlier reduction to as many influences; may be empty.
  //! reduce_by_poisson() starts from them, so that a small change of the weights has a small
  //! effect. Binding::reduced() ignores those of another number of points or control points.
  SparseWeights start{};
};

//! How reduce_influences() reduces.
enum class Reduction {
  kPoisson,   //!< jointly for all points, without seams: reduce_by_poisson()
  kQuadratic  //!< each point independently, faster: sparsify()
};

//! Checks options.
//! \param options  any
//! \throws OptionError naming the invalid option
template <int Dim>
void validate(const SparsifyOptions& options);

//! Replaces the weights of every point by at most `max_influences` nonzero ones with w >= 0, sum w
//! = 1, and sum w c = x. The sum holds to 1e-13, and reproduction to 1e-13 of the size of the
//! control points. Weights that satisfy the limits are unchanged. With default options the result
//! equals that of project_non_negative(). The given weights may be negative and need not reproduce
//! points. A point without weights keeps none. For the chosen influences, the weights minimize |w -
//! given|^2. This is the expected squared error of the point under random independent displacements
//! of the control points. Influences are chosen by repeatedly removing the cheapest one, and by
//! exchange with others whose given weight is at least 1e-3. The choice is usually, but not always,
//! the best one.
//! \param control_points  Dim x n, finite
//! \param points  Dim x P, inside the convex hull of the control points, in the same units
//! \param weights  of P points, finite
//! \param options  valid
//! \return weights of P points
//! \throws OptionError as validate(); InputError if sizes do not match, a value is not finite, or a
//! point lies outside the convex hull of the control points, naming the first such point
template <int Dim>
SparseWeights sparsify(const PointList<Dim>& control_points, const PointList<Dim>& points,
                       const SparseWeights& weights, const SparsifyOptions& options);

//! Reduces influences under the same constraints and with the same accuracy as sparsify(), but
//! jointly for all points. It minimizes the error of differences along edges, so that no seams
//! appear where neighbors keep different influences. The method follows Landreneau and Schaefer,
//! "Poisson-Based Weight Reduction of Animated Meshes", 2010, which drops influences in order of
//! cost. Let d_a be the new minus the given weights of point a, and C_p pose p. The energy is
//!
//!     mean_p ( sum_ab k_ab |C_p (d_a - d_b)|^2 + sum_a m_a / r^2 |C_p d_a|^2 )
//!
//! over edges ab and points a, with m_a = sum_b k_ab |x_a - x_b|^2 / 2. The length r is 1/20 of the
//! size of the points, or five mean edge lengths if that is larger. The second term is small and
//! limits absolute displacements. A tenth of the mean energy of a pose from independent_poses()
//! plus one from smooth_poses() is added, for control points that the given poses do not move.
//! Without given poses, the energy consists of these random poses only.
//!
//! The solver is block coordinate descent: it optimizes the weights of one point while its
//! neighbors are fixed. The result is a local minimum, usually far below the energy of sparsify().
//! Points without edges get the weights of sparsify(). Points with at most Dim given influences
//! keep them, because they lie on the cage and follow its facet. Coincident points with equal
//! weights get equal results. The result does not depend on the number of threads.
//! \param control_points  Dim x n, finite
//! \param points  Dim x P, inside the convex hull of the control points, in the same units
//! \param edges  between the points, with weights in any unit
//! \param weights  of P points, as for sparsify()
//! \param poses  Dim x n each, displaced control points, may be empty
//! \param options  as for sparsify()
//! \return weights of P points
//! \throws OptionError and InputError as sparsify(); InputError also for edges and poses of wrong
//! size
template <int Dim>
SparseWeights reduce_by_poisson(const PointList<Dim>& control_points, const PointList<Dim>& points,
                                const EdgeList& edges, const SparseWeights& weights,
                                const std::vector<PointList<Dim>>& poses,
                                const SparsifyOptions& options);

//! Reduces influences by reduce_by_poisson() if there are edges, otherwise by sparsify(). Weights
//! within the limits only pass sparsify(), as all do for Reduction::kQuadratic.
//! \param control_points  Dim x n, finite
//! \param points  Dim x P, inside the convex hull of the control points, in the same units
//! \param edges  between the points, may be empty
//! \param weights  of P points, as for sparsify()
//! \param poses  Dim x n each, displaced control points, may be empty
//! \param options  as for sparsify()
//! \return weights of P points
//! \throws as these functions
template <int Dim>
SparseWeights reduce_influences(const PointList<Dim>& control_points, const PointList<Dim>& points,
                                const EdgeList& edges, const SparseWeights& weights,
                                const std::vector<PointList<Dim>>& poses,
                                const SparsifyOptions& options,
                                Reduction reduction = Reduction::kPoisson);

//! The energy that reduce_by_poisson() minimizes, for any weights. The unit of displacements is a
//! tenth of cage size.
//! \param control_points  Dim x n, finite
//! \param points  Dim x P
//! \param edges  between the points
//! \param before  given weights of P points
//! \param after  new weights of P points
//! \param poses  Dim x n each, may be empty
//! \return >= 0
//! \throws InputError if sizes of weights, edges, or poses do not match
template <int Dim>
double poisson_cost(const PointList<Dim>& control_points, const PointList<Dim>& points,
                    const EdgeList& edges, const SparseWeights& before, const SparseWeights& after,
                    const std::vector<PointList<Dim>>& poses);

}  // namespace flbc
