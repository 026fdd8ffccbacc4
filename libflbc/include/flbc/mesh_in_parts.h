// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Meshing cages whose interior has several parts.
#pragma once

#include <functional>

#include "flbc/cage.h"
#include "flbc/meshing_options.h"

namespace flbc {

//! A mesher of connected interiors, as triangulate() and tetrahedralize() are.
template <int Dim>
using PartMesher =
    std::function<DomainMesh<Dim>(const Cage<Dim>& cage, const MeshingOptions<Dim>& options)>;

//! Meshes each part of a cage's interior by itself and joins the meshes.
//! \param cage  n control points, has passed validate() and does not intersect itself
//! \param options  for the whole: vertices are shared among the parts by their areas or volumes, at
//! least one for each, points to embed go to the part in which they are
//! \param mesher  called for each part with its own control points first, then its embedded points;
//! with cage and options as they are if there is but one part
//! \return control points, embedded points, then the other vertices part by part
//! \throws InputError if a point to embed is in no part; what the mesher throws, an InputError of a
//! part with the part's number and first control point before it
template <int Dim>
DomainMesh<Dim> mesh_in_parts(const Cage<Dim>& cage, const MeshingOptions<Dim>& options,
                              const PartMesher<Dim>& mesher);

}  // namespace flbc
