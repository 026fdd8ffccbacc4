// SPDX-License-Identifier: BSD-3-Clause
// The cost of changed weights along edges.
#pragma once

#include <vector>

#include "flbc/domain_mesh.h"
#include "flbc/sparse_weights.h"
#include "flbc/types.h"

namespace flbc {

//! H = a I + F^T F, symmetric and positive definite.
struct PoseMetric {
  double identity;         //!< a
  Eigen::MatrixXd factor;  //!< F, r x n, r the rank of F^T F
  Eigen::MatrixXd matrix;  //!< H, n x n
};

//! The metric with d . H d, for differences d of weights with sum d = 0 and sum d c = 0, the
//! squared distance by which d moves a point, in units of a tenth of the cage's size: the mean over
//! the poses plus a tenth of the expectation over poses like those of independent_poses() and
//! smooth_poses(). The second term controls control points that the given poses do not move.
//! Without poses, H is that expectation.
//! \param control_points  Dim x n \param poses  Dim x n each
template <int Dim>
PoseMetric pose_metric(const PointList<Dim>& control_points,
                       const std::vector<PointList<Dim>>& poses);

//! With d_a the new minus the given weights of point a, and x_a its position:
//!
//!     sum_ab k_ab (d_a - d_b) . H (d_a - d_b)  +  sum_a pin m_a d_a . H d_a
//!
//! over edges ab and points a, where m_a = sum_b k_ab |x_a - x_b|^2 / 2.
struct PoissonEnergy {
  PoseMetric metric;  //!< H
  double pin;         //!< weight of absolute displacements, 1 / length^2
};

//! \param control_points  Dim x n \param points  Dim x P \param edges  validated
//! \param poses  Dim x n each \throws InputError if a pose has the wrong size
template <int Dim>
PoissonEnergy make_poisson_energy(const PointList<Dim>& control_points,
                                  const PointList<Dim>& points, const EdgeList& edges,
                                  const std::vector<PointList<Dim>>& poses);

//! \param edges  validated
//! \param before, after  of P points
template <int Dim>
double evaluate(const PoissonEnergy& energy, const PointList<Dim>& points, const EdgeList& edges,
                const SparseWeights& before, const SparseWeights& after);

}  // namespace flbc
