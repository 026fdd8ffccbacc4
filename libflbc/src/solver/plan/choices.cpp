// SPDX-License-Identifier: BSD-3-Clause
#include "solver/plan/choices.h"

#include <algorithm>
#include <cmath>

#include "base/instantiate.h"
#include "base/shape_checks.h"
#include "flbc/bounding_box.h"
#include "flbc/published_penalty.h"
#include "solver/plan/constants.h"

namespace flbc::plan {
namespace {

// Indices of control points are stored in 16 bits.
constexpr Index kMostActiveControlPoints = 65000;

bool gains_by_coarse_start(const Sizes& sizes, const Settings& settings) {
  const bool is_open =
      settings.coarse_to_fine == CoarseToFine::kAuto && !settings.coarse_levels.coarsest;
  return sizes.dim == 2 || !is_open || *settings.tolerance >= kCoarseStartTolerance ||
         active_set(sizes, settings);
}

}  // namespace

bool smooths(Method method) {
  return method == Method::kAuto || method == Method::kValue || method == Method::kGradient;
}

bool inherits(Method method) {
  return method == Method::kValue;
}

LinearSolver linear_solver(const Sizes& sizes, const Settings& settings) {
  if (settings.linear_solver != LinearSolver::kAuto) return settings.linear_solver;
  if (settings.method == Method::kLbc2014) return LinearSolver::kDirect;  // as published
  return sizes.vertices > most_factored(sizes.dim) ? LinearSolver::kMultigrid
                                                   : LinearSolver::kDirect;
}

bool half_precision(Index cells, const Settings& settings) {
  return settings.method == Method::kValue && settings.precision == Precision::kAuto &&
         *settings.tolerance >= kHalfIsEnough && cells >= kHalfCells &&
         *settings.smoothness <= kHalfSmoothness;
}

bool active_set(const Sizes& sizes, const Settings& settings) {
  const auto [dim, n, vertices] = sizes;
  if (settings.method != Method::kValue || n > kMostActiveControlPoints) return false;
  if (settings.active_set != ActiveSet::kAuto) return settings.active_set == ActiveSet::kOn;
  if (static_cast<double>(n) * vertices < kActivePairs) return false;
  return dim == 3 && n >= kActiveControlPoints && !proves(settings);
}

bool proves(const Settings& settings) {
  return settings.certify || (*settings.gap > 0 && !settings.gap_settles);
}

bool active_set_pays(double density, const Settings& settings) {
  return settings.active_set == ActiveSet::kOn || density <= kActiveDensity;
}

double penalty_unit(Method method, int dim, double size) {
  const int measures = method == Method::kLbc2014 ? 2 : method == Method::kValue ? 1 : 0;
  return std::pow(size, dim + 1 - measures * dim);
}

std::vector<Index> coarse_sizes(const Sizes& sizes, const Settings& settings) {
  if (settings.coarse_to_fine == CoarseToFine::kOff || !inherits(settings.method)) return {};
  if (!gains_by_coarse_start(sizes, settings)) return {};
  const auto limits = worthwhile(sizes.dim, active_set(sizes, settings));
  const auto& levels = settings.coarse_levels;
  const Index coarsest = levels.coarsest.value_or(limits.coarsest);
  const double numbers = static_cast<double>(sizes.vertices) * sizes.control_points;
  if (!levels.coarsest && numbers < limits.numbers) return {};
  std::vector<Index> vertices;
  double size = sizes.vertices / limits.factor;
  while (size >= coarsest) {
    vertices.push_back(static_cast<Index>(size));
    size /= limits.factor;
  }
  // An explicit request always gives a coarse mesh.
  if (vertices.empty() && levels.coarsest && sizes.vertices >= 2 * coarsest) {
    vertices.push_back(coarsest);
  }
  std::reverse(vertices.begin(), vertices.end());
  return vertices;
}

bool interpolates_distances(const Sizes& sizes, const Settings& settings, bool has_coarse_mesh) {
  if (settings.phi == DistanceScheme::kConstant) return false;
  if (settings.distances != Distances::kAuto) return settings.distances == Distances::kInterpolated;
  if (settings.method != Method::kValue || *settings.tolerance < kInterpolatedTolerance)
    return false;
  return has_coarse_mesh || (sizes.dim == 3 && sizes.vertices >= kInterpolatedVertices);
}

Index distances_mesh_size(Index vertices, double tolerance) {
  return tolerance >= kCoarsestDistances ? 1 : vertices / kDistancesRatio;
}

}  // namespace flbc::plan

namespace flbc {

template <int Dim>
double published_penalty(const Cage<Dim>& cage, const DomainMesh<Dim>& mesh, Method method,
                         double penalty) {
  SolverOptions options;
  options.penalty = penalty;
  validate(options);
  check_elements(cage.points, cage.facets, kCageNames);
  check_elements(mesh.points, mesh.cells, kMeshNames);
  if (method == Method::kAuto) method = resolve({}).method;
  const double size = plan::published_scale(mesh) * bounding_box_diagonal(cage.points);
  return penalty / plan::penalty_unit(method, Dim, size);
}

FLBC_INSTANTIATE_FUNCTION(published_penalty)

}  // namespace flbc
