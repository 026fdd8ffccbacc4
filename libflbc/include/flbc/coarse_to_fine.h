// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Options of the multilevel start: solve() (solver.h) can start from the solution on coarser
//! meshes of the same cage.
#pragma once

#include <functional>

#include "flbc/cage.h"
#include "flbc/domain_mesh.h"

namespace flbc {

//! Makes a domain mesh with about the given number of vertices, for example with triangulate() or
//! tetrahedralize() (meshing.h). The cage is scaled; the mesh must fill the scaled cage. A solve
//! with several threads calls the mesher from another thread, but never concurrently.
template <int Dim>
using CoarseMesher = std::function<DomainMesh<Dim>(const Cage<Dim>& cage, Index vertices)>;

//! When to use a multilevel start.
enum class CoarseToFine {
  kAuto,  //!< if there is a mesher and measurements show a gain
  kOn,    //!< always, even on small meshes where it costs time; needs a mesher
  kOff    //!< never
};

}  // namespace flbc
