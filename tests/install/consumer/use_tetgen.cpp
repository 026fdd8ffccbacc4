// SPDX-License-Identifier: BSD-3-Clause
// Component tetgen: a mesh of an octahedron.
#include "judge.h"

int main() {
  const auto cage = octahedron();
  const auto mesh = flbc::tetrahedralize(cage, {300});
  return judge<3>(cage, mesh.points, flbc::solve(cage, mesh).weights.dense());
}
