// SPDX-License-Identifier: BSD-3-Clause
// Component netgen: a mesh of an octahedron.
#include <flbc/meshing.h>

#include "judge.h"

int main() {
  flbc::Cage<3> cage;
  cage.points.resize(3, 6);
  cage.points << 1, 0, 0, -1, 0, 0,  //
      0, 1, 0, 0, -1, 0,             //
      0, 0, 1, 0, 0, -1;
  cage.facets.resize(3, 8);
  cage.facets << 0, 1, 3, 4, 1, 3, 4, 0,  //
      1, 3, 4, 0, 0, 1, 3, 4,             //
      2, 2, 2, 2, 5, 5, 5, 5;
  const auto mesh = flbc::tetrahedralize_by_netgen(cage, {300});
  return judge<3>(cage, mesh.points, flbc::solve(cage, mesh).weights.dense());
}
