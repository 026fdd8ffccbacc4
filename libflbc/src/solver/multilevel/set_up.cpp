// SPDX-License-Identifier: BSD-3-Clause
#include "solver/multilevel/set_up.h"

#include <utility>

#include "base/stage_progress.h"
#include "base/stopwatch.h"
#include "flbc/domain_mesh.h"
#include "flbc/errors.h"
#include "problem/problem_geometry.h"
#include "solver/iterative_method.h"
#include "solver/multilevel/choose_distances.h"
#include "solver/multilevel/level_sizes.h"
#include "solver/multilevel/mesh_ahead.h"
#include "solver/supports/choice.h"
#include "solver/warm_start/transfer.h"

namespace flbc {
namespace {

// The largest change that interpolated distances made to the weights of any model, mean squared,
// was 9e-8, and it is not foreseen everywhere: smaller tolerances want exact ones.
constexpr double kLeastTolerance = 1e-7;

// Whether distances are to be interpolated if they turn out to be good enough.
template <int Dim>
bool tries_to_interpolate(Index finest, const CoarseMesher<Dim>& mesher,
                          const SolverOptions& options, bool has_coarse_mesh) {
  // Below, a mesh for the distances alone takes as long as the distances.
  constexpr Index kFewestVertices = 3000;
  if (!mesher || options.phi == DistanceScheme::kConstant) return false;
  if (options.distances != Distances::kAuto) return options.distances == Distances::kInterpolated;
  if (options.method != Method::kValue || options.tolerance < kLeastTolerance) return false;
  return has_coarse_mesh || (Dim == 3 && finest >= kFewestVertices);
}

// In 3D a coarse start of kValue saves the first iterations and none of the last, which are most of
// them where the tolerance is small; a cold one is faster then, as measured.
template <int Dim>
bool gains_by_start(Index n, Index finest, const SolverOptions& options) {
  constexpr double kSmall = 3e-7;
  const bool is_open =
      options.coarse_to_fine == CoarseToFine::kAuto && options.coarse_levels.coarsest == 0;
  return Dim == 2 || options.method != Method::kValue || !is_open || options.tolerance >= kSmall ||
         supports::serve<Dim>(n, finest, options);
}

// The coarse mesh for distances alone: as coarse as the cage allows, or a twelfth of the vertices.
Index size_for_distances(Index finest, double tolerance) {
  constexpr double kCoarsestIsEnough = 1e-6;
  constexpr Index kRatio = 12;
  return tolerance >= kCoarsestIsEnough ? 1 : finest / kRatio;
}

// The coarser meshes that a solve takes, and their purposes.
struct CoarsePlan {
  std::vector<Index> sizes;
  CoarseUse use;
};

//! \param n  number of control points \param finest  number of vertices
template <int Dim>
CoarsePlan plan_coarse(Index n, Index finest, const SolverOptions& options,
                       const CoarseMesher<Dim>& mesher) {
  if (!minimises(options.method)) return {{}, {false, false}};
  auto sizes = start_sizes(n, finest, mesher, options);
  const bool starts = !sizes.empty();
  const bool interpolates = tries_to_interpolate(finest, mesher, options, starts);
  if (interpolates && !starts) sizes = {size_for_distances(finest, options.tolerance)};
  return {std::move(sizes), {starts, interpolates}};
}

template <int Dim>
DistanceMatrix place_and_choose(SetUp<Dim>& result, const SolverOptions& options) {
  auto& coarse = result.coarse.back();
  coarse.finest_vertices =
      places_in_coarse(coarse.problem, result.problem, result.problem.mesh.points);
  return choose_distances(coarse, result.problem, options, result.distances);
}

// A copy, with the places of the finest mesh's vertices.
template <int Dim>
CoarseProblem<Dim> coarsest_of(const SetUp<Dim>& result) {
  auto coarse = result.coarse.front();
  if (coarse.finest_vertices.empty()) {
    coarse.finest_vertices =
        places_in_coarse(coarse.problem, result.problem, result.problem.mesh.points);
  }
  return coarse;
}

}  // namespace

void require_valid(const SolverOptions& options, bool has_mesher) {
  validate(options);
  if (options.coarse_to_fine == CoarseToFine::kOn && !has_mesher) {
    throw OptionError("coarse_to_fine cannot be on without a mesher for the coarser meshes");
  }
}

void require_valid_set_up(const SolverOptions& options, bool has_mesher) {
  require_valid(options, has_mesher);
  if (options.distances == Distances::kInterpolated && !has_mesher) {
    throw OptionError("distances cannot be interpolated without a mesher for a coarser mesh");
  }
}

template <int Dim>
std::vector<Index> start_sizes(Index n, Index finest, const CoarseMesher<Dim>& mesher,
                               const SolverOptions& options) {
  if (!mesher || options.coarse_to_fine == CoarseToFine::kOff || !inherits(options.method)) {
    return {};
  }
  // A penalty of the metric A^2 belongs to one mesh, and who gives it wants the iteration as it is.
  if (options.method == Method::kLbc2014 && options.penalty > 0) return {};
  if (!gains_by_start<Dim>(n, finest, options)) return {};
  return level_sizes<Dim>(finest, n, options.method, supports::serve<Dim>(n, finest, options),
                          options.coarse_levels);
}

template <int Dim>
SetUp<Dim> set_up(Cage<Dim> cage, DomainMesh<Dim> mesh, const SolverOptions& options,
                  const CoarseMesher<Dim>& mesher, std::optional<CoarseProblem<Dim>>* coarsest,
                  const MeshTopology<Dim>* topology) {
  Stopwatch watch;
  require_connected(mesh);
  const auto plan = plan_coarse(cage.size(), mesh.num_vertices(), options, mesher);
  const MeshAhead<Dim> ahead(cage, mesh, plan.sizes, mesher);
  SetUp<Dim> result{topology == nullptr
                        ? make_geometry(std::move(cage), std::move(mesh))
                        : make_geometry(std::move(cage), std::move(mesh), *topology)};
  auto& problem = result.problem;
  if (!minimises(options.method)) {
    result.seconds = watch.lap();
    return result;
  }
  result.coarse = make_coarse_problems(problem, ahead.mesher(), plan.sizes, options, plan.use);
  const StageScope scope(told_of(options, Stage::kDistances));
  auto distances = plan.use.distances && !result.coarse.empty()
                       ? place_and_choose(result, options)
                       : distances_for(options.phi, problem);
  problem.phi = {options.phi, std::move(distances), problem.mesh, problem.num_control_points()};
  if (coarsest != nullptr && result.distances.source == Distances::kInterpolated) {
    *coarsest = coarsest_of(result);
  }
  if (!plan.use.start) result.coarse.clear();
  result.seconds = watch.lap();
  for (const auto& level : result.coarse) {
    result.seconds -= level.report.mesh_seconds + level.report.setup_seconds;
  }
  return result;
}

#define FLBC_INSTANTIATE(Dim)                                                              \
  template std::vector<Index> start_sizes(Index, Index, const CoarseMesher<Dim>&,          \
                                          const SolverOptions&);                           \
  template SetUp<Dim> set_up(Cage<Dim>, DomainMesh<Dim>, const SolverOptions&,             \
                             const CoarseMesher<Dim>&, std::optional<CoarseProblem<Dim>>*, \
                             const MeshTopology<Dim>*);
FLBC_INSTANTIATE(2)
FLBC_INSTANTIATE(3)
#undef FLBC_INSTANTIATE

}  // namespace flbc
