// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Meshing a cage with whatever mesher was built in.
#pragma once

#include "flbc/cage.h"
#include "flbc/meshing.h"

namespace flbc::app {

//! Number of mesh vertices if the user does not ask for one.
constexpr Index kDefaultVertices = 10000;

//! \param vertices  wanted number, 0 = kDefaultVertices or what quality demands if that is more
//! \throws OptionError if the program was built without the mesher for this dimension
template <int Dim>
DomainMesh<Dim> make_domain(const Cage<Dim>& cage, Index vertices,
                            const PointList<Dim>& embedded_points = {});

}  // namespace flbc::app
