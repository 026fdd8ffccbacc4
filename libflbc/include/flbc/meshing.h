// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! From a cage to the mesh of its interior. Meshers and the search for self-intersections are in
//! optional components, because the libraries behind them have copyleft licenses.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "flbc/cage.h"
#include "flbc/domain_mesh.h"
#include "flbc/types.h"

namespace flbc {

//! Demands on the mesh of a cage's interior.
template <int Dim>
struct MeshingOptions {
  //! Number of vertices wanted, met within 5 % in 2D and about 10 % in 3D; 0 = as few as quality
  //! demands. \throws OptionError from the meshers if it is below what quality demands.
  Index vertices = 0;

  //! Points inside the cage that become mesh vertices: they follow the control points directly, in
  //! this order, with their coordinates unchanged.
  PointList<Dim> embedded_points{};

  //! Time limit in seconds for one run of a mesher, including its retries.
  double time_limit = 60;

  //! Accepts the first mesh with about this many vertices, within a factor of three where the cage
  //! allows. One run of the mesher is enough for coarse meshes (coarse_to_fine.h).
  bool roughly = false;
};

//! Points for MeshingOptions::embedded_points, and which of the given points each one stands for.
template <int Dim>
struct EmbeddablePoints {
  PointList<Dim> points;      //!< strictly inside the cage and distinct, in the order given
  std::vector<Index> number;  //!< of each point given among them; -1 = on the cage or outside
};

//! Leaves out points that a mesher cannot distinguish from the cage, a control point or each other
//! (closer than 1e-8 of the cage's size), and points outside.
//! \param cage  has passed validate()
//! \param points  Dim x P, finite, in the units of the cage
template <int Dim>
EmbeddablePoints<Dim> embeddable_points(const Cage<Dim>& cage, const PointList<Dim>& points);

//! Quality triangulation (smallest angle about 20 degrees where the cage allows it) by CGAL's
//! Delaunay mesher. Component `cgal`. Vertices 0 .. n-1 of the mesh are the control points.
//! \param cage  any
//! \param options  number of vertices, points to embed
//! \return a valid mesh, in the units of the cage
//! \throws InputError if the cage is defective, OptionError if the options cannot be met
DomainMesh<2> triangulate(const Cage<2>& cage, const MeshingOptions<2>& options = {});

//! Quality tetrahedralization by TetGen, run in its own process. Component `tetgen`.
//! Vertices 0 .. n-1 of the mesh are the control points.
//! \param cage  any
//! \param options  number of vertices, points to embed, time limit
//! \return a valid mesh, in the units of the cage
//! \throws InputError if the cage is defective or TetGen fails on it, OptionError if the options
//! cannot be met
DomainMesh<3> tetrahedralize(const Cage<3>& cage, const MeshingOptions<3>& options = {});

//! Tetrahedralization by Netgen, run in its own process. Component `netgen`; Netgen's library
//! is loaded at run time. Vertices 0 .. n-1 of the mesh are the control points, and its boundary
//! consists of the cage's facets, divided at the middles of edges. Cells in thin walls are flat,
//! where tetrahedralize() would fill them with ever smaller ones. The number of vertices may be off
//! by a third where the facets of the cage are all alike.
//! \param cage  any
//! \param options  number of vertices and time limit; points cannot be embedded
//! \return a valid mesh, in the units of the cage
//! \throws InputError if the cage is defective or Netgen fails on it, or its library is not there;
//! OptionError if the options cannot be met
DomainMesh<3> tetrahedralize_by_netgen(const Cage<3>& cage, const MeshingOptions<3>& options = {});

//! A mesher of connected interiors, as triangulate() and tetrahedralize() are.
template <int Dim>
using PartMesher =
    std::function<DomainMesh<Dim>(const Cage<Dim>& cage, const MeshingOptions<Dim>& options)>;

//! Meshes each part of the interior of a cage on its own and joins the meshes.
//! \param cage  n control points, has passed validate() and does not intersect itself
//! \param options  for the whole: vertices are shared among the parts by their areas or volumes, at
//! least one for each, points to embed go to the part in which they are
//! \param mesher  called for each part with its own control points first, then its embedded points;
//! with cage and options unchanged if there is one part
//! \return control points, embedded points, then the other vertices part by part
//! \throws InputError if a point to embed is in no part; what the mesher throws, an InputError of a
//! part with the part's number and first control point before it
template <int Dim>
DomainMesh<Dim> mesh_in_parts(const Cage<Dim>& cage, const MeshingOptions<Dim>& options,
                              const PartMesher<Dim>& mesher);

//! Pairs of facets that meet elsewhere than in common vertices or edges. Component `cgal`.
//! \param cage  has passed validate()
//! \param limit  largest number of defects to look for
//! \return at most `limit` defects
template <int Dim>
std::vector<Defect> find_self_intersections(const Cage<Dim>& cage, std::size_t limit = 16);

}  // namespace flbc
