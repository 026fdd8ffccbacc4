// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Which points are neighbours.
#pragma once

#include <array>
#include <vector>

#include "flbc/domain_mesh.h"
#include "flbc/types.h"

namespace flbc {

//! Undirected edges between points.
struct EdgeList {
  //! The two points of each edge, in any order.
  std::vector<std::array<Index, 2>> ends{};

  //! How much each edge counts, > 0; empty stands for 1 each. An edge that is listed twice counts
  //! twice.
  std::vector<double> weights{};
};

//! Checks edges.
//! \param edges  any
//! \param num_points  P
//! \throws InputError if an edge has an end that is none of `num_points` points, or a weight that
//! is not positive and finite, or if there is not one weight per edge
void validate(const EdgeList& edges, Eigen::Index num_points);

//! The edges of the cells, each once, ascending. Their weights make
//!
//!     sum over edges ab of k_ab |f(a) - f(b)|^2
//!
//! an approximation of the integral of |grad f|^2: each cell gives each of its edges an equal share
//! of its area or volume, times its dimension, and k_ab is what an edge got in all, divided by its
//! squared length. On regular cells these are the weights of linear finite elements (cotangents),
//! but they are positive on all others, too, which minimising edge by edge needs.
//! \param mesh  any cells and points
//! \throws InputError if a vertex of a cell is none of the points
template <int Dim>
EdgeList edges_of_cells(const DomainMesh<Dim>& mesh);

//! The same for polygons, whose area is that of the fan around their first vertex, and for
//! polylines.
//! \param points  Dim x P
//! \param polygons  the vertices of each in order, the first not repeated
//! \param polylines  the vertices of each in order; closed if the last is the first
//! \throws InputError if a vertex of a polygon or polyline is none of the points
template <int Dim>
EdgeList edges_of_polygons(const PointList<Dim>& points,
                           const std::vector<std::vector<Index>>& polygons,
                           const std::vector<std::vector<Index>>& polylines = {});

}  // namespace flbc
