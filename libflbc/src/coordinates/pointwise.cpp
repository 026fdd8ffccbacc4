// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/pointwise.h"

#include <numeric>
#include <vector>

#include "base/parallel.h"
#include "flbc/cage_facts.h"
#include "flbc/errors.h"
#include "flbc/non_negative.h"
#include "placement/place_on_cage.h"

namespace flbc {
namespace {

template <int Dim>
WeightMatrix in_part(const Cage<Dim>& cage, const PointList<Dim>& points, Coordinates coordinates) {
  switch (coordinates) {
    case Coordinates::kMeanValue:
      return mean_value_coordinates(cage, points);
    case Coordinates::kMaxEntropy:
      return maximum_entropy_coordinates(cage, points);
    case Coordinates::kMaxLikelihood:
      return maximum_likelihood_coordinates(cage, points);
    case Coordinates::kBlended:
      if constexpr (Dim == 2) return blended_coordinates(cage, points);
      throw OptionError("method blended is for cages in 2D; choose another method");
    default:
      throw OptionError("these coordinates need a domain mesh; use compute_coordinates()");
  }
}

// Numbers of the points by the part with the nearest place of the cage. Parts may be nested, but
// only in holes, so that the nearest place belongs to the part around a point.
template <int Dim>
std::vector<std::vector<Index>> points_of_parts(const Cage<Dim>& cage,
                                                const std::vector<CagePart<Dim>>& parts,
                                                const PointList<Dim>& points) {
  std::vector<std::size_t> part_of(static_cast<std::size_t>(cage.size()));
  for (std::size_t k = 0; k < parts.size(); ++k) {
    for (const Index i : parts[k].control_points) part_of[i] = k;
  }
  std::vector<Index> all(static_cast<std::size_t>(points.cols()));
  std::iota(all.begin(), all.end(), 0);
  std::vector<std::vector<Index>> numbers(parts.size());
  for (const auto& place : nearest_on_cage(cage, points, all)) {
    numbers[part_of[cage.facets(0, place.facet)]].push_back(place.point);
  }
  return numbers;
}

}  // namespace

bool is_pointwise(Coordinates coordinates) {
  return coordinates == Coordinates::kMeanValue || coordinates == Coordinates::kMaxEntropy ||
         coordinates == Coordinates::kMaxLikelihood || coordinates == Coordinates::kBlended;
}

template <int Dim>
WeightMatrix pointwise_coordinates(const Cage<Dim>& cage, const PointList<Dim>& points,
                                   Coordinates coordinates) {
  const auto parts = cage_parts(cage);
  if (parts.size() == 1) return in_part(cage, points, coordinates);
  const auto numbers = points_of_parts(cage, parts, points);
  WeightMatrix weights = WeightMatrix::Zero(cage.size(), points.cols());
  for (std::size_t k = 0; k < parts.size(); ++k) {
    const PointList<Dim> some = points(Eigen::all, numbers[k]);
    weights(parts[k].control_points, numbers[k]) = in_part(parts[k].cage, some, coordinates);
  }
  return weights;
}

template <int Dim>
SparseWeights pointwise_coordinates(const Cage<Dim>& cage, const Placement<Dim>& placement,
                                    Coordinates coordinates, bool non_negative, int num_threads) {
  check_placement(cage, placement);
  const ThreadScope threads(num_threads);
  PointList<Dim> points = placement.points;
  std::vector<bool> is_beside(static_cast<std::size_t>(points.cols()), false);
  for (const auto* beside : {&placement.on_cage, &placement.outside}) {
    for (const auto& [point, facet, corners, distance] : *beside) {
      is_beside[point] = true;
      points.col(point) = cage.points.col(cage.facets(0, facet));  // not used
    }
  }
  auto weights = pointwise_coordinates(cage, points, coordinates);
  if (non_negative) {
    std::vector<Index> inside;
    for (Index p = 0; p < points.cols(); ++p) {
      if (!is_beside[p]) inside.push_back(p);
    }
    return weights_at(cage, project_non_negative<Dim>(cage.points, points, weights, inside),
                      placement);
  }
  return weights_at(cage, weights, placement);
}

#define FLBC_INSTANTIATE(Dim)                                                           \
  template WeightMatrix pointwise_coordinates(const Cage<Dim>&, const PointList<Dim>&,  \
                                              Coordinates);                             \
  template SparseWeights pointwise_coordinates(const Cage<Dim>&, const Placement<Dim>&, \
                                               Coordinates, bool, int);
FLBC_INSTANTIATE(2)
FLBC_INSTANTIATE(3)
#undef FLBC_INSTANTIATE

}  // namespace flbc
