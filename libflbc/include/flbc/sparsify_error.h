// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! The error of reduced weights: in weights, in deformations, and in differences along edges.
#pragma once

#include <vector>

#include "flbc/domain_mesh.h"
#include "flbc/sparse_weights.h"
#include "flbc/types.h"

namespace flbc {

//! Number of weights per point.
struct Influences {
  double mean = 0;
  Index max = 0;
};

//! Counts nonzero weights, or only those above a threshold.
//! \param weights  of P points
//! \param threshold  a weight counts if |w_i| is above it; kInfluenceThreshold counts as Quality does
Influences count_influences(const SparseWeights& weights, double threshold = 0);

//! Root mean square and maximum.
struct ErrorNorms {
  double rms = 0;
  double max = 0;
};

//! Norms of the differences of individual weights.
//! \param before, after  of P points
//! \throws InputError if sizes differ
ErrorNorms weight_error(const SparseWeights& before, const SparseWeights& after);

//! Norms of the distances between points deformed with the two sets of weights, over all points and
//! poses.
//! \param poses  Dim x n each, displaced control points
//! \param before, after  of P points
//! \return lengths in the units of the poses
//! \throws InputError if sizes do not match
template <int Dim>
ErrorNorms deformation_error(const std::vector<PointList<Dim>>& poses, const SparseWeights& before,
                             const SparseWeights& after);

//! Norms of the error of edge vectors, relative to the rest edges. With e = |C_p (d_a - d_b)|, rms
//! = sqrt(mean_p sum k e^2 / sum k |x_a - x_b|^2) and max = max e / |x_a - x_b|, over edges of
//! nonzero length.
//! \param points  Dim x P, at rest
//! \param edges  between the points
//! \param poses  Dim x n each, in the units of the points
//! \param before, after  of P points
//! \return relative to edge lengths
//! \throws InputError if sizes do not match
template <int Dim>
ErrorNorms edge_error(const PointList<Dim>& points, const EdgeList& edges,
                      const std::vector<PointList<Dim>>& poses, const SparseWeights& before,
                      const SparseWeights& after);

}  // namespace flbc
