// SPDX-License-Identifier: BSD-3-Clause
// The core with a given mesh: four triangles around a point of the square.
#include "judge.h"

int main() {
  const auto cage = square();
  flbc::DomainMesh<2> mesh;
  mesh.points.resize(2, 5);
  mesh.points << cage.points, Eigen::Vector2d(0.25, 0.5);
  mesh.cells = flbc::CellList<2>{{0, 1, 2, 3}, {1, 2, 3, 0}, {4, 4, 4, 4}};
  return judge<2>(cage, mesh.points, flbc::solve(cage, mesh).weights.dense());
}
