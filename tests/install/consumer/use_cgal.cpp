// SPDX-License-Identifier: BSD-3-Clause
// Component cgal: a mesh of the square.
#include "judge.h"

int main() {
  const auto cage = square();
  const auto mesh = flbc::triangulate(cage, {200});
  return judge<2>(cage, mesh.points, flbc::solve(cage, mesh).weights.dense());
}
