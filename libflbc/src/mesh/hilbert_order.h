// SPDX-License-Identifier: BSD-3-Clause
// Order along the Hilbert curve, so that neighbors in space are close in memory.
#pragma once

#include <cstdint>
#include <vector>

#include "flbc/domain_mesh.h"

namespace flbc {

//! Position of a grid cell on the Hilbert curve that fills a grid of 2^levels cells along each
//! axis.
//! \param cell  Dim numbers below 2^levels; Dim * levels <= 63
template <int Dim>
std::uint64_t hilbert_index(const std::uint32_t (&cell)[Dim], int levels);

//! A permutation of 0 .. #points-1 along the Hilbert curve through the bounding box; points in the
//! same grid cell keep their order.
template <int Dim>
std::vector<Index> spatial_order(const PointList<Dim>& points);

//! Renumbers the vertices after the first `num_fixed` by their positions and the cells by their
//! centroids.
template <int Dim>
void reorder_in_space(DomainMesh<Dim>& mesh, Index num_fixed);

}  // namespace flbc
