// SPDX-License-Identifier: BSD-3-Clause
// Does not compile, and says why.
#include <OpenMesh/Core/Mesh/PolyMesh_ArrayKernelT.hh>

#include "flbc/openmesh/lbc.h"

void solve_on_a_surface(OpenMesh::PolyMesh_ArrayKernelT<>& model, const flbc::Cage<3>& cage) {
  flbc::openmesh::solve(model, cage);
}
