// SPDX-License-Identifier: BSD-3-Clause
#include "solver/multilevel/coarse_problem.h"

#include <exception>
#include <new>
#include <optional>
#include <utility>

#include "base/instantiate.h"
#include "base/stopwatch.h"
#include "flbc/domain_mesh.h"
#include "problem/geodesic/interpolated_distances.h"
#include "problem/problem_geometry.h"
#include "solver/plan/choices.h"
#include "solver/plan/constants.h"
#include "solver/start/transfer.h"

namespace flbc {
namespace {

// Makes a mesh that is a useful level between the one below (0 vertices = none) and the finest.
template <int Dim>
std::optional<DomainMesh<Dim>> make_mesh(const CoarseMesher<Dim>& mesher, const Cage<Dim>& cage,
                                         Index wanted, Index below, Index finest) {
  try {
    auto mesh = mesher(cage, wanted);
    if (plan::kClearlyFiner * mesh.num_vertices() > finest ||
        mesh.num_vertices() < plan::kClearlyFiner * below)
      return {};
    normalize_and_validate(mesh);
    require_connected(mesh);
    return mesh;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception&) {
    return {};
  }
}

// Inherited distances are checked when the finest mesh uses them.
// \param below  next coarser problem; null: none
template <int Dim>
void measure_phi(const CoarseProblem<Dim>* below, const plan::Settings& settings, CoarseUse use,
                 CoarseProblem<Dim>& level) {
  std::optional<DistanceMatrix> distances;
  if (use.distances && below != nullptr) {
    distances = distances_from(below->problem, level.problem,
                               places_in(below->problem, level.problem.mesh.points));
  }
  if (!distances) distances = distances_for(settings.phi, level.problem);
  set_phi(level.problem, settings.phi, std::move(*distances));
}

}  // namespace

template <int Dim>
DistanceMatrix distances_from(const LbcProblem<Dim>& coarse, const LbcProblem<Dim>& problem,
                              const std::vector<Location<Dim>>& places) {
  return interpolated_distances<Dim>({coarse.mesh, coarse.cage.points, coarse.phi.distances()},
                                     problem.mesh.points, places);
}

template <int Dim>
std::vector<CoarseProblem<Dim>> make_coarse_problems(const LbcProblem<Dim>& problem,
                                                     const CoarseMesher<Dim>& mesher,
                                                     const std::vector<Index>& sizes,
                                                     const plan::Settings& settings,
                                                     CoarseUse use) {
  std::vector<CoarseProblem<Dim>> coarse;
  for (const Index size : sizes) {
    Stopwatch watch;
    const auto* below = coarse.empty() ? nullptr : &coarse.back();
    auto mesh = make_mesh(mesher, problem.cage, size, below ? below->report.vertices : 0,
                          problem.mesh.num_vertices());
    if (!mesh) continue;
    LevelReport report;
    report.vertices = mesh->num_vertices();
    report.cells = mesh->num_cells();
    report.mesh_seconds = watch.lap();
    CoarseProblem<Dim> level{make_geometry(problem.cage, std::move(*mesh))};
    level.problem.smoothness = problem.smoothness;
    measure_phi(below, settings, use, level);
    report.setup_seconds = watch.lap();
    level.report = report;
    coarse.push_back(std::move(level));
  }
  return coarse;
}

FLBC_INSTANTIATE_FUNCTION(distances_from)
FLBC_INSTANTIATE_FUNCTION(make_coarse_problems)

}  // namespace flbc
