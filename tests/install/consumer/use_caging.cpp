// SPDX-License-Identifier: BSD-3-Clause
// Component caging: a cage around the square, and coordinates of the square in it.
#include <flbc/cage_from_model.h>

#include "judge.h"

int main() {
  const auto model = square();
  const auto cage = flbc::cage_from_model<2>(model.points, model.facets).cage;
  const auto mesh = flbc::triangulate(cage, {200});
  return judge<2>(cage, mesh.points, flbc::solve(cage, mesh).weights.dense());
}
