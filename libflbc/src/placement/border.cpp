// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/border.h"

#include <cmath>

#include <Eigen/LU>

#include "base/instantiate.h"
#include "base/parallel.h"
#include "flbc/bounding_box.h"

namespace flbc {
namespace {

// Relative volume of the simplex below which a segment counts as parallel to a facet. It then
// passes through a neighbor of that facet.
constexpr double kParallel = 1e-12;

// Where a segment passes through a facet. \return whether it does
template <int Dim>
bool cross(const Cage<Dim>& cage, Eigen::Index facet, const Vector<Dim>& from,
           const Vector<Dim>& to, Vector<Dim>& coordinates) {
  const Vector<Dim> corner = cage.points.col(cage.facets(0, facet));
  Eigen::Matrix<double, Dim, Dim> system;
  for (int k = 1; k < Dim; ++k) system.col(k - 1) = cage.points.col(cage.facets(k, facet)) - corner;
  system.col(Dim - 1) = from - to;
  // Some programs, such as OpenFOAM, end at divisions by zero.
  if (std::abs(system.determinant()) <= kParallel * system.colwise().norm().prod()) return false;
  const Vector<Dim> place = system.inverse() * (from - corner);
  coordinates << 1 - place.template head<Dim - 1>().sum(), place.template head<Dim - 1>();
  if (coordinates.minCoeff() < -kBoundaryTolerance || place[Dim - 1] < 0 || place[Dim - 1] > 1) {
    return false;
  }
  coordinates = coordinates.cwiseMax(0);
  coordinates /= coordinates.sum();
  return true;
}

}  // namespace

std::vector<bool> are_still(const SparseWeights& weights) {
  std::vector<bool> still(static_cast<std::size_t>(weights.num_points()));
  for (Index p = 0; p < weights.num_points(); ++p) still[p] = !weights.has_weights(p);
  return still;
}

template <int Dim>
std::vector<BorderCrossing<Dim>> find_crossings(const Cage<Dim>& cage, const PointList<Dim>& points,
                                                const std::vector<bool>& is_still,
                                                const EdgeList& edges) {
  std::vector<BorderCrossing<Dim>> candidates;
  for (const auto& [a, b] : edges.ends) {
    if (is_still[a] == is_still[b]) continue;
    candidates.push_back({{is_still[a] ? b : a, is_still[a] ? a : b}});
  }
  // Vertices that move may be outside by the tolerance.
  const double margin = 2 * kBoundaryTolerance * bounding_box_diagonal(cage.points);
  std::vector<std::vector<BorderCrossing<Dim>>> found(candidates.size());
  parallel_for(static_cast<Index>(candidates.size()), [&](Index k) {
    auto crossing = candidates[k];
    const Vector<Dim> to = points.col(crossing.ends[1]);
    Vector<Dim> from = points.col(crossing.ends[0]);
    const double length = (to - from).norm();
    if (length == 0) return;
    from -= margin / length * (to - from);
    for (Eigen::Index f = 0; f < cage.facets.cols(); ++f) {
      if (!cross<Dim>(cage, f, from, to, crossing.coordinates)) continue;
      crossing.facet = static_cast<Index>(f);
      found[k].push_back(crossing);
    }
  });
  std::vector<BorderCrossing<Dim>> crossings;
  for (const auto& some : found) crossings.insert(crossings.end(), some.begin(), some.end());
  return crossings;
}

template <int Dim>
std::vector<Index> control_points_at(const Cage<Dim>& cage,
                                     const std::vector<BorderCrossing<Dim>>& crossings) {
  std::vector<bool> is_chosen(cage.size(), false);
  for (const auto& crossing : crossings) {
    for (int k = 0; k < Dim; ++k) {
      if (crossing.coordinates[k] <= kBoundaryTolerance) continue;
      is_chosen[cage.facets(k, crossing.facet)] = true;
    }
  }
  std::vector<Index> chosen;
  for (Index i = 0; i < cage.size(); ++i) {
    if (is_chosen[i]) chosen.push_back(i);
  }
  return chosen;
}

template <int Dim>
BorderJump largest_jump(const Cage<Dim>& cage, const std::vector<BorderCrossing<Dim>>& crossings,
                        const PointList<Dim>& displacements) {
  BorderJump largest;
  for (std::size_t c = 0; c < crossings.size(); ++c) {
    Vector<Dim> jump = Vector<Dim>::Zero();
    for (int k = 0; k < Dim; ++k) {
      jump += crossings[c].coordinates[k] * displacements.col(cage.facets(k, crossings[c].facet));
    }
    if (largest.crossing >= 0 && jump.norm() <= largest.length) continue;
    largest = {jump.norm(), static_cast<Index>(c)};
  }
  return largest;
}

FLBC_INSTANTIATE_FUNCTION(find_crossings)
FLBC_INSTANTIATE_FUNCTION(control_points_at)
FLBC_INSTANTIATE_FUNCTION(largest_jump)

}  // namespace flbc
