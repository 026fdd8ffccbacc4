// SPDX-License-Identifier: BSD-3-Clause
#include "solver/multilevel/coarse_problem.h"

#include <exception>
#include <optional>
#include <utility>

#include "base/stopwatch.h"
#include "flbc/mesh_parts.h"
#include "problem/problem_geometry.h"

namespace flbc {
namespace {

// A mesh worth a level of its own between the one below (0 vertices = none) and the finest.
template <int Dim>
std::optional<DomainMesh<Dim>> make_mesh(const CoarseMesher<Dim>& mesher, const Cage<Dim>& cage,
                                         Index wanted, Index below, Index finest) {
  constexpr double kClearly = 1.7;
  try {
    auto mesh = mesher(cage, wanted);
    if (kClearly * mesh.num_vertices() > finest || mesh.num_vertices() < kClearly * below)
      return {};
    normalize_and_validate(mesh);
    require_connected(mesh);
    return mesh;
  } catch (const std::exception&) {
    return {};
  }
}

}  // namespace

template <int Dim>
std::vector<CoarseProblem<Dim>> make_coarse_problems(const LbcProblem<Dim>& problem,
                                                     const CoarseMesher<Dim>& mesher,
                                                     const std::vector<Index>& sizes,
                                                     DistanceScheme scheme) {
  std::vector<CoarseProblem<Dim>> coarse;
  for (const Index size : sizes) {
    Stopwatch watch;
    const Index below = coarse.empty() ? 0 : coarse.back().report.vertices;
    auto mesh = make_mesh(mesher, problem.cage, size, below, problem.mesh.num_vertices());
    if (!mesh) continue;
    LevelReport report;
    report.vertices = mesh->num_vertices();
    report.cells = mesh->num_cells();
    report.mesh_seconds = watch.lap();
    auto geometry = make_geometry(problem.cage, std::move(*mesh));
    auto distances = distances_for(scheme, geometry);
    geometry.phi = {scheme, distances, geometry.mesh, problem.num_control_points()};
    report.setup_seconds = watch.lap();
    coarse.push_back({std::move(geometry), std::move(distances), {}, report});
  }
  return coarse;
}

template std::vector<CoarseProblem<2>> make_coarse_problems(const LbcProblem<2>&,
                                                            const CoarseMesher<2>&,
                                                            const std::vector<Index>&,
                                                            DistanceScheme);
template std::vector<CoarseProblem<3>> make_coarse_problems(const LbcProblem<3>&,
                                                            const CoarseMesher<3>&,
                                                            const std::vector<Index>&,
                                                            DistanceScheme);

}  // namespace flbc
