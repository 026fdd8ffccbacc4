// SPDX-License-Identifier: BSD-3-Clause
#include "solver/multilevel/set_up.h"

#include <omp.h>

#include <future>
#include <memory>
#include <utility>

#include "base/instantiate.h"
#include "base/stage_progress.h"
#include "base/stopwatch.h"
#include "flbc/domain_mesh.h"
#include "problem/problem_geometry.h"
#include "problem/unit_scale.h"
#include "solver/multilevel/coarse_distances.h"
#include "solver/plan/choices.h"
#include "solver/plan/constants.h"
#include "solver/start/transfer.h"

namespace flbc {
namespace {

// The coarse meshes of a solve, and their purposes.
struct CoarsePlan {
  std::vector<Index> sizes;
  CoarseUse use;
};

CoarsePlan plan_coarse(const plan::Sizes& sizes, const plan::Settings& settings, bool has_mesher) {
  if (!has_mesher) return {{}, {false, false}};
  auto coarse = plan::coarse_sizes(sizes, settings);
  const bool starts = !coarse.empty();
  const bool interpolates = plan::interpolates_distances(sizes, settings, starts);
  if (interpolates && !starts) coarse = {sizes.vertices / plan::kCoarseFactor};
  return {std::move(coarse), {starts, interpolates}};
}

// Wraps a mesher to make the first mesh in advance. With several threads, it is made in a separate
// thread while the finest problem is set up.
// \param cage  of the finest mesh, unscaled \param mesher  must outlive the result
template <int Dim>
CoarseMesher<Dim> mesh_ahead(const Cage<Dim>& cage, const std::vector<Index>& sizes,
                             const CoarseMesher<Dim>& mesher) {
  if (sizes.empty() || omp_get_max_threads() == 1) return mesher;
  auto scaled = cage;
  scaled.points = UnitScale<Dim>(cage)(cage.points);
  auto first = std::make_shared<std::future<DomainMesh<Dim>>>(std::async(
      std::launch::async | std::launch::deferred, [&mesher, scaled, size = sizes.front()] {
        omp_set_num_threads(1);  // other threads are busy
        return mesher(scaled, size);
      }));
  return [first, &mesher](const Cage<Dim>& coarse_cage, Index vertices) {
    return first->valid() ? first->get() : mesher(coarse_cage, vertices);
  };
}

// Locates the vertices of the finest mesh in a coarse one, once.
template <int Dim>
CoarseProblem<Dim>& with_places(CoarseProblem<Dim>& coarse, const LbcProblem<Dim>& finest) {
  if (coarse.finest_vertices.empty()) {
    coarse.finest_vertices = places_in(coarse.problem, finest.mesh.points);
  }
  return coarse;
}

}  // namespace

template <int Dim>
SetUp<Dim> set_up(Cage<Dim> cage, DomainMesh<Dim> mesh, const plan::Settings& settings,
                  const CoarseMesher<Dim>& mesher, const Reporter& reporter,
                  std::optional<CoarseProblem<Dim>>* coarsest, const MeshTopology<Dim>* topology) {
  Stopwatch watch;
  require_connected(mesh);
  const auto [sizes, use] =
      plan_coarse({Dim, cage.size(), mesh.num_vertices()}, settings, bool(mesher));
  const auto begun_mesher = mesh_ahead(cage, sizes, mesher);
  SetUp<Dim> result{topology == nullptr
                        ? make_geometry(std::move(cage), std::move(mesh))
                        : make_geometry(std::move(cage), std::move(mesh), *topology)};
  auto& [problem, coarse, report, seconds] = result;
  problem.smoothness = *settings.smoothness;
  coarse = make_coarse_problems(problem, begun_mesher, sizes, settings, use);
  {
    const StageScope scope(reporter.stage(Stage::kDistances));
    set_phi(problem, settings.phi,
            use.distances && !coarse.empty()
                ? choose_distances(with_places(coarse.back(), problem), problem, settings, report)
                : distances_for(settings.phi, problem));
  }
  if (coarsest != nullptr && report.source == Distances::kInterpolated) {
    *coarsest = with_places(coarse.front(), problem);
  }
  if (!use.start) coarse.clear();
  seconds = watch.lap();
  for (const auto& level : coarse) {
    seconds -= level.report.mesh_seconds + level.report.setup_seconds;
  }
  return result;
}

FLBC_INSTANTIATE_FUNCTION(set_up)

}  // namespace flbc
