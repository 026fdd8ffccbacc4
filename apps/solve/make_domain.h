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
//! \param vertices  wanted number, 0 = kDefaultVertices; where quality demands more, that
//! \param embedded_file  the model whose points become mesh vertices; empty for none
//! \param time_limit  of one run of the mesher, in seconds
//! \throws OptionError if the program was built without the mesher for this dimension
template <int Dim>
DomainMesh<Dim> make_domain(const std::string& cage_file, const Cage<Dim>& cage, Index vertices,
                            const std::string& embedded_file, const PointList<Dim>& model,
                            double time_limit);

//! A note that a mesh has more vertices than were asked for, for the user; empty if it has not.
//! \param asked  0 = no number in particular
std::string note_on_count(Index asked, Index count);

//! Meshes of the cage's interior for a start from coarser ones; empty if the program was built
//! without the mesher for this dimension.
template <int Dim>
CoarseMesher<Dim> coarse_mesher();

}  // namespace flbc::app
