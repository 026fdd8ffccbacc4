// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Meshing a cage with whatever mesher was built in.
#pragma once

#include <string>

#include "flbc/cage.h"
#include "flbc/coarse_to_fine.h"
#include "flbc/meshing.h"

namespace flbc::app {

//! Number of mesh vertices if the user does not ask for one.
constexpr Index kDefaultVertices = 10000;

//! \param cage_file  named in messages
//! \param vertices  wanted number, 0 = kDefaultVertices or what quality demands if that is more
//! \param embedded_file  the model whose points become mesh vertices; empty for none
//! \throws OptionError if the program was built without the mesher for this dimension
template <int Dim>
DomainMesh<Dim> make_domain(const std::string& cage_file, const Cage<Dim>& cage, Index vertices,
                            const std::string& embedded_file, const PointList<Dim>& model);

//! Meshes of the cage's interior for a start from coarser ones; empty if the program was built
//! without the mesher for this dimension.
template <int Dim>
CoarseMesher<Dim> coarse_mesher();

}  // namespace flbc::app
