// SPDX-License-Identifier: BSD-3-Clause
#include "solver/multilevel/set_up.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "base/parallel.h"
#include "base/stage_progress.h"
#include "base/stopwatch.h"
#include "flbc/mesh_parts.h"
#include "problem/problem_geometry.h"
#include "solver/iterative_method.h"
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

// Some control points: from the one that is the farthest from a part of the domain, in even steps
// to the one that is the nearest to all of it.
std::vector<Index> choose_control_points(const DistanceMatrix& distances) {
  constexpr Index kOneIn = 32;
  constexpr Index kMost = 10;
  const auto n = static_cast<Index>(distances.rows());
  const Index count = std::min({n, 2 + n / kOneIn, kMost});
  const Eigen::VectorXf farthest = distances.rowwise().maxCoeff();
  std::vector<Index> order(n);
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](Index a, Index b) { return farthest[a] > farthest[b]; });
  std::vector<Index> chosen;
  for (Index k = 0; k < count; ++k) chosen.push_back(order[k * (n - 1) / std::max(1, count - 1)]);
  return chosen;
}

// Puts exact distances in for some control points and tells how far phi was off there, within the
// reaches.
template <int Dim>
double check_on_sample(const LbcProblem<Dim>& problem, DistanceScheme scheme,
                       const Eigen::VectorXf& reach, DistanceMatrix& distances) {
  const auto chosen = choose_control_points(distances);
  const auto count = static_cast<Index>(chosen.size());
  std::vector<Index> sources;
  DistanceMatrix both(2 * count, distances.cols());
  for (Index k = 0; k < count; ++k) {
    sources.push_back(problem.boundary.control_vertices[chosen[k]]);
    both.row(k) = distances.row(chosen[k]);
  }
  both.bottomRows(count) = geodesic_distances(problem.mesh, problem.topology, sources);
  for (Index k = 0; k < count; ++k) {
    distances.row(chosen[k]) = both.row(count + k);
    if (reach.size() == 0) continue;
    for (const Index row : {k, count + k}) both.row(row) = both.row(row).cwiseMin(reach[chosen[k]]);
  }
  const WeightFunctions phi(scheme, std::move(both), problem.mesh, 2 * count);
  const Eigen::Vector2d zero = Eigen::Vector2d::Zero();
  const auto squares = parallel_sum(problem.mesh.num_cells(), zero, [&](Index begin, Index end) {
    Eigen::Vector2d sum = zero;  // of the differences, and of phi
    for (Index s = begin; s < end; ++s) {
      const Eigen::VectorXd on_cell = phi.col(s);
      sum[0] += (on_cell.head(count) - on_cell.tail(count)).squaredNorm();
      sum[1] += on_cell.tail(count).squaredNorm();
    }
    return sum;
  });
  return std::sqrt(squares[0] / squares[1]);
}

// The mean squared change of weights by a relative error of phi: four times what it was on any
// model where the error was 0.4 % and more (docs/results.md).
double weight_error(double phi_error) {
  constexpr double kInfluence = 3e-4;
  return kInfluence * phi_error * phi_error;
}

template <int Dim>
DistanceMatrix choose_distances(SetUp<Dim>& result, const SolverOptions& options) {
  constexpr double kPart = 0.5;  // of the tolerance
  auto& coarse = result.coarse.back();
  coarse.finest_vertices =
      places_in_coarse(coarse.problem, result.problem, result.problem.mesh.points);
  auto distances = distances_from(coarse.problem, result.problem, coarse.finest_vertices);
  const auto enlarged = static_cast<float>(enlargement(coarse.problem, result.problem));
  const double error =
      check_on_sample(result.problem, options.phi, enlarged * coarse.reach, distances);
  if (options.distances == Distances::kAuto && weight_error(error) > kPart * options.tolerance) {
    return distances_for(options.phi, result.problem);
  }
  result.distances = {Distances::kInterpolated, coarse.report.vertices, error};
  return distances;
}

}  // namespace

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
                  const CoarseMesher<Dim>& mesher) {
  Stopwatch watch;
  require_connected(mesh);
  const auto plan = plan_coarse(cage.size(), mesh.num_vertices(), options, mesher);
  const MeshAhead<Dim> ahead(cage, mesh, plan.sizes, mesher);
  SetUp<Dim> result{make_geometry(std::move(cage), std::move(mesh))};
  auto& problem = result.problem;
  if (!minimises(options.method)) {
    result.seconds = watch.lap();
    return result;
  }
  result.coarse = make_coarse_problems(problem, ahead.mesher(), plan.sizes, options, plan.use);
  const StageScope scope(told_of(options, Stage::kDistances));
  auto distances = plan.use.distances && !result.coarse.empty()
                       ? choose_distances(result, options)
                       : distances_for(options.phi, problem);
  problem.phi = {options.phi, std::move(distances), problem.mesh, problem.num_control_points()};
  if (!plan.use.start) result.coarse.clear();
  result.seconds = watch.lap();
  for (const auto& level : result.coarse) {
    result.seconds -= level.report.mesh_seconds + level.report.setup_seconds;
  }
  return result;
}

#define FLBC_INSTANTIATE(Dim)                                                     \
  template std::vector<Index> start_sizes(Index, Index, const CoarseMesher<Dim>&, \
                                          const SolverOptions&);                  \
  template SetUp<Dim> set_up(Cage<Dim>, DomainMesh<Dim>, const SolverOptions&,    \
                             const CoarseMesher<Dim>&);
FLBC_INSTANTIATE(2)
FLBC_INSTANTIATE(3)
#undef FLBC_INSTANTIATE

}  // namespace flbc
