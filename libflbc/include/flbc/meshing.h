// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! From a cage to the mesh of its interior. The two functions live in optional components, because
//! the libraries behind them have copyleft licences.
#pragma once

#include <vector>

#include "flbc/cage.h"
#include "flbc/domain_mesh.h"

namespace flbc {

//! What the mesh of a cage's interior has to be like.
template <int Dim>
struct MeshingOptions {
  //! Number of vertices wanted, met within 5 % in 2D and about 10 % in 3D; 0 = as few as quality
  //! demands. \throws OptionError from the meshers if it is below what quality demands.
  Index vertices = 0;

  //! Points inside the cage that become mesh vertices: they follow the control points directly, in
  //! this order, with their coordinates unchanged.
  PointList<Dim> embedded_points{};

  //! Longest time in seconds for one run of an external mesher, after which it is stopped.
  double time_limit = 600;
};

//! Quality triangulation (smallest angle about 20 degrees where the cage allows it) by CGAL's
//! Delaunay mesher. Component `cgal`. Vertices 0 .. n-1 of the mesh are the control points. \throws
//! InputError if the cage is defective, OptionError if the options cannot be met.
DomainMesh<2> triangulate(const Cage<2>& cage, const MeshingOptions<2>& options = {});

//! Quality tetrahedralisation by TetGen, run in a process of its own. Component `tetgen`.
//! Vertices 0 .. n-1 of the mesh are the control points.
//! \throws InputError if the cage is defective or TetGen fails on it, OptionError if the options
//! cannot be met.
DomainMesh<3> tetrahedralize(const Cage<3>& cage, const MeshingOptions<3>& options = {});

//! Pairs of facets that meet elsewhere than in common vertices or edges. Component `cgal`.
//! The cage must have passed validate(). \return at most `limit` defects.
template <int Dim>
std::vector<Defect> find_self_intersections(const Cage<Dim>& cage, std::size_t limit = 16);

}  // namespace flbc
