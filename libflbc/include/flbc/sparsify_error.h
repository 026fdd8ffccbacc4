// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! How far sparse weights are from those given, in weights and in deformations.
#pragma once

#include <vector>

#include "flbc/sparse_weights.h"
#include "flbc/types.h"

namespace flbc {

//! Numbers of weights other than 0 per point.
struct Influences {
  double mean = 0;
  Index max = 0;
};

//! Counts weights other than 0.
//! \param weights  n x P
Influences count_influences(const WeightMatrix& weights);

//! The same for weights without their zeros.
Influences count_influences(const SparseWeights& weights);

//! Root of the mean square, and largest.
struct ErrorNorms {
  double rms = 0;
  double max = 0;
};

//! The norms of the differences of single weights.
//! \param before  n x P
//! \param after  n x P
//! \throws InputError if sizes differ
ErrorNorms weight_error(const WeightMatrix& before, const WeightMatrix& after);

//! The same for weights without their zeros.
ErrorNorms weight_error(const SparseWeights& before, const SparseWeights& after);

//! The norms of the distances between points deformed with either weights, over all points and
//! poses.
//! \param poses  Dim x n each, the displaced control points
//! \param before  n x P
//! \param after  n x P
//! \return lengths in the units of the poses
//! \throws InputError if sizes do not fit
template <int Dim>
ErrorNorms deformation_error(const std::vector<PointList<Dim>>& poses, const WeightMatrix& before,
                             const WeightMatrix& after);

//! The same for weights without their zeros.
template <int Dim>
ErrorNorms deformation_error(const std::vector<PointList<Dim>>& poses, const SparseWeights& before,
                             const SparseWeights& after);

}  // namespace flbc
