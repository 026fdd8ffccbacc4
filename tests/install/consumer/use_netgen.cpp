// SPDX-License-Identifier: BSD-3-Clause
// Component netgen: a mesh of an octahedron.
#include <flbc/meshing.h>

#include "judge.h"

int main() {
  const auto cage = octahedron();
  const auto mesh = flbc::tetrahedralize_by_netgen(cage, {300});
  return judge<3>(cage, mesh.points, flbc::solve(cage, mesh).weights.dense());
}
