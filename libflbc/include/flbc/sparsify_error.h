// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! How far sparse weights are from those given, in weights, in deformations and in differences
//! along edges.
#pragma once

#include <vector>

#include "flbc/domain_mesh.h"
#include "flbc/sparse_weights.h"
#include "flbc/types.h"

namespace flbc {

//! Numbers of weights per point.
struct Influences {
  double mean = 0;
  Index max = 0;
};

//! Counts the weights that are stored, or of these only the influences.
//! \param weights  n x P
//! \param threshold  counts |w_i| above it; kInfluenceThreshold for influences as Quality has them
Influences count_influences(const SparseWeights& weights, double threshold = 0);

//! Root of the mean square, and largest.
struct ErrorNorms {
  double rms = 0;
  double max = 0;
};

//! The norms of the differences of single weights.
//! \param before  n x P
//! \param after  n x P
//! \throws InputError if sizes differ
ErrorNorms weight_error(const SparseWeights& before, const SparseWeights& after);

//! The norms of the distances between points deformed with either weights, over all points and
//! poses.
//! \param poses  Dim x n each, the displaced control points
//! \param before  n x P
//! \param after  n x P
//! \return lengths in the units of the poses
//! \throws InputError if sizes do not fit
template <int Dim>
ErrorNorms deformation_error(const std::vector<PointList<Dim>>& poses, const SparseWeights& before,
                             const SparseWeights& after);

//! The norms of the differences along edges between points deformed with either weights, relative
//! to the edges at rest: with e = |C_p (d_a - d_b)|, rms = sqrt(mean_p sum k e^2 /
//! sum k |x_a - x_b|^2) and max = max e / |x_a - x_b|, over the edges that have a length.
//! \param points  Dim x P, at rest
//! \param edges  between the points
//! \param poses  Dim x n each, in the units of the points
//! \param before  n x P
//! \param after  n x P
//! \return relative to the lengths of edges
//! \throws InputError if sizes do not fit
template <int Dim>
ErrorNorms edge_error(const PointList<Dim>& points, const EdgeList& edges,
                      const std::vector<PointList<Dim>>& poses, const SparseWeights& before,
                      const SparseWeights& after);

}  // namespace flbc
