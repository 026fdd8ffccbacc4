// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! From a polygon to a triangle mesh of its interior. Implemented by the optional component `cgal`.
#pragma once

#include "flbc/cage.h"
#include "flbc/domain_mesh.h"
#include "flbc/meshing_options.h"

namespace flbc {

//! Quality triangulation (smallest angle about 20 degrees where the cage allows it) by CGAL's
//! Delaunay mesher. Component `cgal`. Vertices 0 .. n-1 of the mesh are the control points.
//! \param cage  any
//! \param options  number of vertices, points to embed
//! \return a valid mesh, in the units of the cage
//! \throws InputError if the cage is defective, OptionError if the options cannot be met
DomainMesh<2> triangulate(const Cage<2>& cage, const MeshingOptions<2>& options = {});

}  // namespace flbc
