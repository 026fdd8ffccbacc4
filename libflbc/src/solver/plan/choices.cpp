// SPDX-License-Identifier: BSD-3-Clause
#include "solver/plan/choices.h"

#include <algorithm>
#include <cmath>

#include "base/instantiate.h"
#include "flbc/bounding_box.h"
#include "flbc/published_penalty.h"
#include "solver/plan/constants.h"

namespace flbc::plan {
namespace {

// Indices of control points are stored in 16 bits.
constexpr Index kMostActiveControlPoints = 65000;

NonNegative non_negative(const SolverOptions& options) {
  if (options.non_negative != NonNegative::kAuto) return options.non_negative;
  switch (options.method) {
    case Method::kValue:
    case Method::kLbc2014:
      return NonNegative::kConstraint;
    case Method::kGradient:
      return NonNegative::kProject;
    default:
      return NonNegative::kOff;
  }
}

// \param options  with non_negative resolved, and the tolerance as given
double gap(const SolverOptions& options) {
  if (options.gap) return *options.gap;
  const bool by_default = options.method == Method::kValue || options.method == Method::kGradient;
  const bool proves = options.non_negative != NonNegative::kOff;
  return by_default && proves && !options.tolerance ? kGap : 0;
}

double relaxation(const SolverOptions& options) {
  if (options.relaxation) return *options.relaxation;
  switch (options.method) {
    case Method::kValue:
      return kRelaxation;
    case Method::kLbc2014:
      return options.penalty ? kPublishedRelaxation : kRelaxation;
    case Method::kGradient:
      return kGradientRelaxation;
    default:
      return 1;
  }
}

bool gains_by_coarse_start(const Sizes& sizes, const SolverOptions& options) {
  const bool is_open =
      options.coarse_to_fine == CoarseToFine::kAuto && !options.coarse_levels.coarsest;
  return sizes.dim == 2 || !is_open || *options.tolerance >= kCoarseStartTolerance ||
         active_set(sizes, options);
}

}  // namespace

bool smooths(Method method) {
  return method == Method::kAuto || method == Method::kValue || method == Method::kGradient;
}

bool inherits(Method method) {
  return method == Method::kValue;
}

LinearSolver linear_solver(const Sizes& sizes, const SolverOptions& options) {
  if (options.linear_solver != LinearSolver::kAuto) return options.linear_solver;
  if (options.method == Method::kLbc2014) return LinearSolver::kDirect;  // as published
  return sizes.vertices > most_factored(sizes.dim) ? LinearSolver::kMultigrid
                                                   : LinearSolver::kDirect;
}

bool half_precision(Index cells, const SolverOptions& options) {
  return options.method == Method::kValue && options.precision == Precision::kAuto &&
         *options.tolerance >= kHalfIsEnough && cells >= kHalfCells &&
         *options.smoothness <= kHalfSmoothness;
}

bool active_set(const Sizes& sizes, const SolverOptions& options) {
  const auto [dim, n, vertices] = sizes;
  if (options.method != Method::kValue || n > kMostActiveControlPoints) return false;
  if (options.active_set != ActiveSet::kAuto) return options.active_set == ActiveSet::kOn;
  if (static_cast<double>(n) * vertices < kActivePairs) return false;
  return dim == 3 && n >= kActiveControlPoints && !proves(options);
}

bool proves(const SolverOptions& options) {
  return options.certify || (options.gap && *options.gap > 0 && *options.gap != kGap);
}

GapTarget gap_target(const SolverOptions& options, bool on_active_set) {
  if (on_active_set) return {};
  return {*options.gap, *options.gap == kGap};
}

bool active_set_pays(double density, const SolverOptions& options) {
  return options.active_set == ActiveSet::kOn || density <= kActiveDensity;
}

double penalty_unit(Method method, int dim, double size) {
  const int measures = method == Method::kLbc2014 ? 2 : method == Method::kValue ? 1 : 0;
  return std::pow(size, dim + 1 - measures * dim);
}

std::vector<Index> coarse_sizes(const Sizes& sizes, const SolverOptions& options) {
  if (options.coarse_to_fine == CoarseToFine::kOff || !inherits(options.method)) return {};
  if (!gains_by_coarse_start(sizes, options)) return {};
  const auto limits = worthwhile(sizes.dim, active_set(sizes, options));
  const auto& levels = options.coarse_levels;
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

bool interpolates_distances(const Sizes& sizes, const SolverOptions& options,
                            bool has_coarse_mesh) {
  if (options.phi == DistanceScheme::kConstant) return false;
  if (options.distances != Distances::kAuto) return options.distances == Distances::kInterpolated;
  if (options.method != Method::kValue || *options.tolerance < kInterpolatedTolerance) return false;
  return has_coarse_mesh || (sizes.dim == 3 && sizes.vertices >= kInterpolatedVertices);
}

Index distances_mesh_size(Index vertices, double tolerance) {
  return tolerance >= kCoarsestDistances ? 1 : vertices / kDistancesRatio;
}

}  // namespace flbc::plan

namespace flbc {

void make_smooth(SolverOptions& options) {
  if (!options.smoothness && plan::smooths(options.method)) {
    options.smoothness = kDeformationSmoothness;
  }
}

SolverOptions resolve(SolverOptions options) {
  if (options.method == Method::kAuto) options.method = Method::kValue;
  const bool gradient = options.method == Method::kGradient;
  options.non_negative = plan::non_negative(options);
  options.gap = plan::gap(options);
  if (options.coarse_to_fine == CoarseToFine::kOn && !options.coarse_levels.coarsest) {
    options.coarse_levels.coarsest = plan::kCoarsest;
  }
  if (!options.tolerance)
    options.tolerance = gradient ? plan::kGradientTolerance : plan::kTolerance;
  options.relaxation = plan::relaxation(options);
  options.smoothness = options.smoothness.value_or(0);
  return options;
}

template <int Dim>
double published_penalty(const Cage<Dim>& cage, const DomainMesh<Dim>& mesh, Method method,
                         double penalty) {
  SolverOptions options;
  options.penalty = penalty;
  validate(options);
  if (method == Method::kAuto) method = resolve({}).method;
  const double size = plan::published_scale(mesh) * bounding_box_diagonal(cage.points);
  return penalty / plan::penalty_unit(method, Dim, size);
}

FLBC_INSTANTIATE_FUNCTION(published_penalty)

}  // namespace flbc
