// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Where a model passes through its cage. Vertices outside that stay where they are
//! (OutsidePoints::kKeep) meet there vertices that the cage moves.
#pragma once

#include <vector>

#include "flbc/cage.h"
#include "flbc/domain_mesh.h"
#include "flbc/sparse_weights.h"
#include "flbc/types.h"

namespace flbc {

//! A place where an edge of a model passes through a facet of the cage.
template <int Dim>
struct BorderCrossing {
  Index ends[2] = {-1, -1};  //!< of the edge: the vertex that moves, and the one that does not
  Index facet = -1;
  Vector<Dim> coordinates = Vector<Dim>::Zero();  //!< barycentric in the facet: >= 0, sum 1
};

//! Whether each point has no weights, so that it does not move.
std::vector<bool> are_still(const SparseWeights& weights);

//! Finds where edges between vertices that move and vertices that do not pass through the cage.
//! Time is proportional to the number of such edges times the number of facets.
//! \param cage  has passed validate()
//! \param points  Dim x P, in the units of the cage
//! \param is_still  whether each point does not move
//! \param edges  between the points
//! \return in the order of the edges and the facets; several where an edge passes through an edge
//! or a corner of the cage
template <int Dim>
std::vector<BorderCrossing<Dim>> find_crossings(const Cage<Dim>& cage, const PointList<Dim>& points,
                                                const std::vector<bool>& is_still,
                                                const EdgeList& edges);

//! The control points that must not move, so that the deformation is continuous at the crossings.
//! \return ascending
template <int Dim>
std::vector<Index> control_points_at(const Cage<Dim>& cage,
                                     const std::vector<BorderCrossing<Dim>>& crossings);

//! The largest jump of the deformation at crossings, and where it is.
struct BorderJump {
  double length = 0;
  Index crossing = -1;  //!< -1: there are none
};

//! \param displacements  of the control points, Dim x n
template <int Dim>
BorderJump largest_jump(const Cage<Dim>& cage, const std::vector<BorderCrossing<Dim>>& crossings,
                        const PointList<Dim>& displacements);

}  // namespace flbc
