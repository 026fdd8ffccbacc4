// SPDX-License-Identifier: BSD-3-Clause
// Times how long it takes to find the edges, faces and neighbours of a tetrahedral mesh: cubes of a
// grid cut into six tetrahedra, about 0.1, 0.3 and 1 million. Prints the best of the repetitions as
// comma-separated values.
//
//   flbc_bench_tet_mesh [REPETITIONS]
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <functional>
#include <limits>

#include "flbc/domain_mesh.h"
#include "flbc/openmesh/domain.h"
#include "flbc/openmesh/tet_mesh.h"

namespace {

using namespace flbc;

// Cubes side^3, each cut into the six tetrahedra between its corners (0, 0, 0) and (1, 1, 1).
DomainMesh<3> cut_grid(Index side) {
  constexpr int kOrders[6][3] = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {1, 0, 2}, {2, 1, 0}};
  const Index steps[3] = {1, side + 1, (side + 1) * (side + 1)};
  DomainMesh<3> mesh;
  mesh.points.resize(3, (side + 1) * (side + 1) * (side + 1));
  for (Index v = 0; v < mesh.num_vertices(); ++v) {
    mesh.points.col(v) << v % (side + 1), v / steps[1] % (side + 1), v / steps[2];
  }
  mesh.cells.resize(4, 6 * side * side * side);
  Index cell = 0;
  for (Index v = 0; v < mesh.num_vertices(); ++v) {
    if (mesh.points.col(v).maxCoeff() >= side) continue;
    for (const auto& order : kOrders) {
      const Index a = v + steps[order[0]];
      const Index b = a + steps[order[1]];
      mesh.cells.col(cell++) << v, a, b, b + steps[order[2]];
    }
  }
  normalize_and_validate(mesh);
  return mesh;
}

double best_seconds(int repetitions, const std::function<void()>& action) {
  using Clock = std::chrono::steady_clock;
  double best = std::numeric_limits<double>::infinity();
  for (int k = 0; k < repetitions; ++k) {
    const auto start = Clock::now();
    action();
    best = std::min(best, std::chrono::duration<double>(Clock::now() - start).count());
  }
  return best;
}

std::size_t count_neighbours(const openmesh::TetMesh& mesh) {
  std::size_t count = 0;
  for (const auto vertex : mesh.vertices()) count += mesh.vc_range(vertex).size();
  return count;
}

// Only the connectivity, without the checks of assign().
openmesh::TetMesh build(const DomainMesh<3>& mesh) {
  openmesh::TetMesh result;
  result.assign_valid(mesh);
  return result;
}

void run(Index side, int repetitions) {
  const auto mesh = cut_grid(side);
  const auto tets = build(mesh);
  const double built = best_seconds(repetitions, [&] { build(mesh); });
  const double checked = best_seconds(repetitions, [&] { openmesh::TetMesh::from(mesh); });
  const double facets = best_seconds(repetitions, [&] { build_topology(mesh); });
  const double domain = best_seconds(repetitions, [&] { openmesh::make_domain(tets); });
  const double round = best_seconds(repetitions, [&] {
    if (count_neighbours(tets) != 4 * tets.n_cells()) std::abort();
  });
  std::printf("%d,%zu,%zu,%.4g,%.4g,%.4g,%.4g,%.4g\n", mesh.num_cells(), tets.n_faces(),
              tets.n_edges(), built, checked, facets, domain, round);
}

}  // namespace

int main(int count, char** words) {
  try {
    const int repetitions = count > 1 ? std::max(1, std::atoi(words[1])) : 5;
    std::printf(
        "cells,faces,edges,tet_mesh_seconds,checked_seconds,facets_seconds,domain_seconds,"
        "neighbours_seconds\n");
    for (const Index side : {26, 37, 55}) run(side, repetitions);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "flbc_bench_tet_mesh: %s\n", error.what());
    return 1;
  }
}
