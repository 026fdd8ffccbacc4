// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Meshes the interior of a cage. Meshers and the search for self-intersections are optional
//! components, because they depend on libraries with copyleft licenses.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "flbc/cage.h"
#include "flbc/domain_mesh.h"
#include "flbc/types.h"

namespace flbc {

//! Options of the domain mesh.
template <int Dim>
struct MeshingOptions {
  //! Target number of vertices, met within 5% in 2D and about 10% in 3D; 0 = the minimum that
  //! element quality allows. The meshers throw OptionError if the target is below this minimum.
  //! Where the minimum allows it, the mesh is a coarser one after refine() (nested_mesh.h), from
  //! which a solve starts.
  Index vertices = 0;

  //! Points inside the cage that become mesh vertices with the same coordinates. They directly
  //! follow the control points, in this order.
  PointList<Dim> embedded_points{};

  //! Time limit in seconds for one run of a mesher, including retries.
  double time_limit = 60;

  //! Called about every 0.1 s while the mesher runs. What it throws ends the mesher and passes
  //! through.
  std::function<void()> poll{};
};

//! Points for MeshingOptions::embedded_points, and their relation to the given points.
template <int Dim>
struct EmbeddablePoints {
  PointList<Dim> points;      //!< distinct points strictly inside the cage, in the given order
  std::vector<Index> number;  //!< per given point: its index in `points`; -1 = on the cage or
                              //!< outside
};

//! Selects the points that can be embedded. Points outside the cage are left out, and points within
//! 1e-8 of cage size from the cage or from each other, because a mesher cannot separate them.
//! \param cage  has passed validate()
//! \param points  Dim x P, finite, in the units of the cage
template <int Dim>
EmbeddablePoints<Dim> embeddable_points(const Cage<Dim>& cage, const PointList<Dim>& points);

//! Triangulates with the Delaunay mesher of CGAL (component `cgal`). Angles are at least about 20
//! degrees where the cage allows it. Vertices 0 .. n-1 of the mesh are the control points.
//! \param cage  any
//! \param options  number of vertices, points to embed
//! \return a valid mesh, in the units of the cage
//! \throws InputError if the cage is defective, OptionError if the options cannot be met
DomainMesh<2> triangulate(const Cage<2>& cage, const MeshingOptions<2>& options = {});

//! Tetrahedralizes with TetGen in a separate process (component `tetgen`). Vertices 0 .. n-1 of the
//! mesh are the control points.
//! \param cage  any
//! \param options  number of vertices, points to embed, time limit
//! \return a valid mesh, in the units of the cage
//! \throws InputError if the cage is defective or TetGen fails on it, OptionError if the options
//! cannot be met
DomainMesh<3> tetrahedralize(const Cage<3>& cage, const MeshingOptions<3>& options = {});

//! Tetrahedralizes with Netgen in a separate process (component `netgen`). The Netgen library is
//! loaded at run time. Vertices 0 .. n-1 of the mesh are the control points. The boundary consists
//! of the cage facets, subdivided at edge midpoints. Thin walls get flat cells, where
//! tetrahedralize() would make very small ones. The number of vertices may be off by a third if all
//! cage facets have similar size.
//! \param cage  any
//! \param options  number of vertices and time limit; points cannot be embedded
//! \return a valid mesh, in the units of the cage
//! \throws InputError if the cage is defective, Netgen fails on it, or its library is missing;
//! OptionError if the options cannot be met
DomainMesh<3> tetrahedralize_by_netgen(const Cage<3>& cage, const MeshingOptions<3>& options = {});

//! A mesher of connected interiors, such as triangulate() or tetrahedralize().
template <int Dim>
using PartMesher =
    std::function<DomainMesh<Dim>(const Cage<Dim>& cage, const MeshingOptions<Dim>& options)>;

//! Meshes each part of the interior of a cage on its own and joins the meshes.
//! \param cage  n control points, valid and free of self-intersections
//! \param options  for the whole mesh. Each part gets a share of the vertices by area or volume, at
//! least one, and the embedded points that lie in it
//! \param mesher  called once per part; with unchanged arguments if there is one part
//! \return vertices in the order: control points, embedded points, other vertices part by part
//! \throws InputError if an embedded point is in no part. Exceptions of the mesher pass through; an
//! InputError gets the number and first control point of the part as a prefix
template <int Dim>
DomainMesh<Dim> mesh_in_parts(const Cage<Dim>& cage, const MeshingOptions<Dim>& options,
                              const PartMesher<Dim>& mesher);

//! Finds pairs of facets that intersect outside common vertices or edges (component `cgal`).
//! \param cage  has passed validate()
//! \param limit  maximum number of defects to return
//! \return at most `limit` defects
template <int Dim>
std::vector<Defect> find_self_intersections(const Cage<Dim>& cage, std::size_t limit = 16);

}  // namespace flbc
