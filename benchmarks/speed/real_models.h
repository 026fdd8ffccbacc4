// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Meshing cages for the benchmark programs.
#pragma once

#include "flbc/lbc_problem.h"
#include "flbc/meshing.h"
#include "flbc/quality.h"

namespace flbc::bench {

//! How to mesh with about so many vertices. \param roughly  in one run of the mesher
template <int Dim>
MeshingOptions<Dim> meshing_options(Index vertices, bool roughly) {
  MeshingOptions<Dim> options;
  options.vertices = vertices;
  options.roughly = roughly;
  return options;
}

//! Meshes a cage. Parameters as above.
inline DomainMesh<2> mesh_of(const Cage<2>& cage, Index vertices, bool roughly = false) {
  return triangulate(cage, meshing_options<2>(vertices, roughly));
}
inline DomainMesh<3> mesh_of(const Cage<3>& cage, Index vertices, bool roughly = false) {
  return tetrahedralize(cage, meshing_options<3>(vertices, roughly));
}

}  // namespace flbc::bench
