// SPDX-License-Identifier: BSD-3-Clause
#include "solver/multilevel/set_up.h"

#include <utility>

#include "base/stage_progress.h"
#include "base/stopwatch.h"
#include "flbc/domain_mesh.h"
#include "problem/problem_geometry.h"
#include "solver/multilevel/choose_distances.h"
#include "solver/multilevel/mesh_ahead.h"
#include "solver/plan/choices.h"
#include "solver/start/transfer.h"

namespace flbc {
namespace {

// The coarser meshes that a solve takes, and their purposes.
struct CoarsePlan {
  std::vector<Index> sizes;
  CoarseUse use;
};

CoarsePlan plan_coarse(const plan::Sizes& sizes, const SolverOptions& options, bool has_mesher) {
  if (!has_mesher || !plan::minimizes(options.method)) return {{}, {false, false}};
  auto coarse = plan::coarse_sizes(sizes, options);
  const bool starts = !coarse.empty();
  const bool interpolates = plan::interpolates_distances(sizes, options, starts);
  if (interpolates && !starts) {
    coarse = {plan::distances_mesh_size(sizes.vertices, *options.tolerance)};
  }
  return {std::move(coarse), {starts, interpolates}};
}

template <int Dim>
DistanceMatrix place_and_choose(SetUp<Dim>& result, const SolverOptions& options) {
  auto& coarse = result.coarse.back();
  coarse.finest_vertices = places_in(coarse.problem, result.problem.mesh.points);
  return choose_distances(coarse, result.problem, options, result.distances);
}

// A copy, with the places of the finest mesh's vertices.
template <int Dim>
CoarseProblem<Dim> coarsest_of(const SetUp<Dim>& result) {
  auto coarse = result.coarse.front();
  if (coarse.finest_vertices.empty()) {
    coarse.finest_vertices = places_in(coarse.problem, result.problem.mesh.points);
  }
  return coarse;
}

}  // namespace

template <int Dim>
SetUp<Dim> set_up(Cage<Dim> cage, DomainMesh<Dim> mesh, const SolverOptions& options,
                  const CoarseMesher<Dim>& mesher, const Reporter& reporter,
                  std::optional<CoarseProblem<Dim>>* coarsest, const MeshTopology<Dim>* topology) {
  Stopwatch watch;
  require_connected(mesh);
  const auto coarse = plan_coarse({Dim, cage.size(), mesh.num_vertices()}, options, bool(mesher));
  const MeshAhead<Dim> ahead(cage, coarse.sizes, mesher);
  SetUp<Dim> result{topology == nullptr
                        ? make_geometry(std::move(cage), std::move(mesh))
                        : make_geometry(std::move(cage), std::move(mesh), *topology)};
  auto& problem = result.problem;
  if (!plan::minimizes(options.method)) {
    result.seconds = watch.lap();
    return result;
  }
  result.coarse = make_coarse_problems(problem, ahead.mesher(), coarse.sizes, options, coarse.use);
  const StageScope scope(reporter.stage(Stage::kDistances));
  auto distances = coarse.use.distances && !result.coarse.empty()
                       ? place_and_choose(result, options)
                       : distances_for(options.phi, problem);
  set_phi(problem, options.phi, std::move(distances));
  if (coarsest != nullptr && result.distances.source == Distances::kInterpolated) {
    *coarsest = coarsest_of(result);
  }
  if (!coarse.use.start) result.coarse.clear();
  result.seconds = watch.lap();
  for (const auto& level : result.coarse) {
    result.seconds -= level.report.mesh_seconds + level.report.setup_seconds;
  }
  return result;
}

#define FLBC_INSTANTIATE(Dim)                                                  \
  template SetUp<Dim> set_up(Cage<Dim>, DomainMesh<Dim>, const SolverOptions&, \
                             const CoarseMesher<Dim>&, const Reporter&,        \
                             std::optional<CoarseProblem<Dim>>*, const MeshTopology<Dim>*);
FLBC_INSTANTIATE(2)
FLBC_INSTANTIATE(3)
#undef FLBC_INSTANTIATE

}  // namespace flbc
