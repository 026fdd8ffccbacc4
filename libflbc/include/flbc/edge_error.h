// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! How far sparse weights are from those given, in differences along edges.
#pragma once

#include <vector>

#include "flbc/edge_list.h"
#include "flbc/sparsify_error.h"
#include "flbc/types.h"

namespace flbc {

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
                      const std::vector<PointList<Dim>>& poses, const WeightMatrix& before,
                      const WeightMatrix& after);

//! The same for weights without their zeros.
template <int Dim>
ErrorNorms edge_error(const PointList<Dim>& points, const EdgeList& edges,
                      const std::vector<PointList<Dim>>& poses, const SparseWeights& before,
                      const SparseWeights& after);

}  // namespace flbc
