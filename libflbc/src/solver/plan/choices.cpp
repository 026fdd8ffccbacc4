// SPDX-License-Identifier: BSD-3-Clause
#include "solver/plan/choices.h"

#include <algorithm>
#include <cmath>

#include "base/instantiate.h"
#include "base/shape_checks.h"
#include "flbc/bounding_box.h"
#include "flbc/options.h"
#include "solver/plan/constants.h"

namespace flbc::plan {

bool smooths(Method method) {
  return method == Method::kWeights || method == Method::kGradient;
}

bool inherits(Method method) {
  return method == Method::kWeights;
}

bool active_set(const Sizes& sizes, const Settings& settings) {
  if (settings.method != Method::kWeights || sizes.control_points > kMostActiveControlPoints)
    return false;
  if (sizes.masked) return true;
  // Supports that grow with reach are found too late: 5 to 11 tolerances on samples.
  const auto& reach = settings.reach;
  if (std::any_of(reach.begin(), reach.end(), [](double factor) { return factor != 1; })) {
    return false;
  }
  if (settings.active_set != ActiveSet::kAuto) return settings.active_set == ActiveSet::kOn;
  return sizes.dim == 3 && !proves(settings);
}

bool active_set_is_complete(const Sizes& sizes, const Settings& settings, bool cold) {
  if (!sizes.masked) return false;
  const double pairs = static_cast<double>(sizes.control_points) * sizes.vertices;
  return proves(settings) || (cold && pairs < kActivePairs);
}

bool proves(const Settings& settings) {
  return settings.certify || *settings.gap > 0;
}

bool active_set_pays(double density, const Sizes& sizes, const Settings& settings) {
  return settings.active_set == ActiveSet::kOn || sizes.masked || density <= kActiveDensity;
}

double penalty_unit(Method method, int dim, double size) {
  const int measures = method == Method::kLbc2014 ? 2 : method == Method::kWeights ? 1 : 0;
  return std::pow(size, dim + 1 - measures * dim);
}

bool interpolates(const Settings& settings, double error) {
  if (settings.phi == DistanceScheme::kConstant) return false;
  if (settings.distances != Distances::kAuto) return settings.distances == Distances::kInterpolated;
  return !proves(settings) &&
         kWeightsOfPhi * error * error <= kPartOfTolerance * *settings.tolerance;
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
  const double size = plan::published_scale(mesh) * bounding_box_diagonal(cage.points);
  return penalty / plan::penalty_unit(method, Dim, size);
}

FLBC_INSTANTIATE_FUNCTION(published_penalty)

}  // namespace flbc
