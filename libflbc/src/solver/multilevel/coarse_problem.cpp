// SPDX-License-Identifier: BSD-3-Clause
#include "solver/multilevel/coarse_problem.h"

#include <exception>
#include <optional>
#include <utility>

#include "base/stopwatch.h"
#include "flbc/mesh_parts.h"
#include "problem/geodesic/interpolated_distances.h"
#include "problem/problem_geometry.h"
#include "solver/warm_start/transfer.h"

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
Eigen::MatrixXd distances_from(const LbcProblem<Dim>& coarse, const LbcProblem<Dim>& problem,
                               const std::vector<Location<Dim>>& places) {
  return enlargement(coarse, problem) *
         interpolated_distances<Dim>({coarse.mesh, coarse.cage.points, coarse.phi.distances()},
                                     points_in_coarse(coarse, problem, problem.mesh.points),
                                     places);
}

template <int Dim>
std::vector<CoarseProblem<Dim>> make_coarse_problems(const LbcProblem<Dim>& problem,
                                                     const CoarseMesher<Dim>& mesher,
                                                     const std::vector<Index>& sizes,
                                                     DistanceScheme scheme, bool interpolates) {
  std::vector<CoarseProblem<Dim>> coarse;
  for (const Index size : sizes) {
    Stopwatch watch;
    const Index vertices_below = coarse.empty() ? 0 : coarse.back().report.vertices;
    auto mesh = make_mesh(mesher, problem.cage, size, vertices_below, problem.mesh.num_vertices());
    if (!mesh) continue;
    LevelReport report;
    report.vertices = mesh->num_vertices();
    report.cells = mesh->num_cells();
    report.mesh_seconds = watch.lap();
    auto geometry = make_geometry(problem.cage, std::move(*mesh));
    // They are checked where the finest mesh takes them over.
    const auto interpolated = [&] {
      const auto& below = coarse.back().problem;
      return distances_from(below, geometry,
                            places_in_coarse(below, geometry, geometry.mesh.points));
    };
    auto distances =
        interpolates && !coarse.empty() ? interpolated() : distances_for(scheme, geometry);
    geometry.phi = {scheme, std::move(distances), geometry.mesh, problem.num_control_points()};
    report.setup_seconds = watch.lap();
    coarse.push_back({std::move(geometry), {}, report});
  }
  return coarse;
}

#define FLBC_INSTANTIATE(Dim)                                                                      \
  template Eigen::MatrixXd distances_from(const LbcProblem<Dim>&, const LbcProblem<Dim>&,          \
                                          const std::vector<Location<Dim>>&);                      \
  template std::vector<CoarseProblem<Dim>> make_coarse_problems(                                   \
      const LbcProblem<Dim>&, const CoarseMesher<Dim>&, const std::vector<Index>&, DistanceScheme, \
      bool);
FLBC_INSTANTIATE(2)
FLBC_INSTANTIATE(3)
#undef FLBC_INSTANTIATE

}  // namespace flbc
