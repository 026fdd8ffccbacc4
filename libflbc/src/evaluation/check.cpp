// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/check.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "base/parallel.h"
#include "base/shape_checks.h"
#include "cage/facet_locator.h"
#include "evaluation/check_mesh.h"
#include "evaluation/extremes.h"
#include "flbc/bounding_box.h"
#include "flbc/errors.h"
#include "problem/problem_geometry.h"

namespace flbc {
namespace {

constexpr double kCoincidence = 1e-10;  // of the cage's size: a point that near is at the place
constexpr double kRounding = 1e-12;     // a weight not more than this below 0 is not negative

// Counts and extremes of weights; those of parts are added up in the order of points.
template <int Dim>
struct WeightExtremes {
  std::int64_t non_finite = 0, negative = 0, influences = 0, finite_points = 0;
  Extreme<Dim> first_non_finite, min_weight, max_weight, partition, reproduction, most_influences;

  WeightExtremes& operator+=(const WeightExtremes& next) {
    non_finite += next.non_finite;
    negative += next.negative;
    influences += next.influences;
    finite_points += next.finite_points;
    if (first_non_finite.point < 0) first_non_finite = next.first_non_finite;
    keep_smaller(min_weight, next.min_weight);
    keep_larger(max_weight, next.max_weight);
    keep_larger(partition, next.partition);
    keep_larger(reproduction, next.reproduction);
    keep_larger(most_influences, next.most_influences);
    return *this;
  }
};

template <int Dim, class Column>
void add_non_finite(WeightExtremes<Dim>& extremes, const Column& column, Index p,
                    const Vector<Dim>& place) {
  for (Index i = 0; i < column.size(); ++i) {
    if (std::isfinite(column[i])) continue;
    ++extremes.non_finite;
    if (extremes.first_non_finite.point < 0) extremes.first_non_finite = {column[i], p, i, place};
  }
}

template <int Dim>
void add_point(WeightExtremes<Dim>& extremes, const Cage<Dim>& cage, double size, Index p,
               const Vector<Dim>& place, const WeightMatrix& weights) {
  const auto column = weights.col(p);
  if (!column.allFinite()) return add_non_finite(extremes, column, p, place);
  ++extremes.finite_points;
  Index lowest = 0, highest = 0;
  const double least = column.minCoeff(&lowest);
  const double most = column.maxCoeff(&highest);
  const auto influences = (column.array().abs() > kInfluenceThreshold).count();
  const Vector<Dim> error = cage.points * column - place;
  extremes.negative += (column.array() < -kRounding).count();
  extremes.influences += influences;
  keep_smaller(extremes.min_weight, {least, p, lowest, place});
  keep_larger(extremes.max_weight, {most, p, highest, place});
  keep_larger(extremes.partition, {std::abs(column.sum() - 1), p, -1, place});
  keep_larger(extremes.reproduction, {error.norm() / size, p, -1, place});
  keep_larger(extremes.most_influences, {static_cast<double>(influences), p, -1, place});
}

// A point on the cage and the weights that it must have.
template <int Dim>
struct KnownWeights {
  Index point;
  Eigen::Matrix<Index, Dim, 1> control_points;
  Vector<Dim> values;          //!< of these; the others' are 0
  Index coinciding_with = -1;  //!< the control point that lies there, if one does
};

template <int Dim>
void measure_known_weights(WeightCheck<Dim>& check, const PointList<Dim>& points,
                           const WeightMatrix& weights,
                           const std::vector<KnownWeights<Dim>>& known) {
  std::vector<bool> is_found(weights.rows(), false);
  for (const auto& at : known) {
    ++check.points_on_cage;
    if (at.coinciding_with >= 0) is_found[at.coinciding_with] = true;
    const Vector<Dim> place = points.col(at.point);
    Eigen::VectorXd deviation = weights.col(at.point);
    if (!deviation.allFinite()) continue;
    for (int k = 0; k < Dim; ++k) deviation[at.control_points[k]] -= at.values[k];
    Index i = 0;
    const double linearity = deviation.cwiseAbs().maxCoeff(&i);
    keep_larger(check.linearity, {linearity, at.point, i, place});
    if (at.coinciding_with < 0) continue;
    Eigen::VectorXd beside_one = weights.col(at.point);
    beside_one[at.coinciding_with] -= 1;
    const double lagrange = beside_one.cwiseAbs().maxCoeff(&i);
    keep_larger(check.lagrange, {lagrange, at.point, i, place});
  }
  check.control_points_found =
      static_cast<Index>(std::count(is_found.begin(), is_found.end(), true));
}

template <int Dim>
std::vector<KnownWeights<Dim>> find_points_on_cage(const Cage<Dim>& cage,
                                                   const PointList<Dim>& points) {
  const double tolerance = kCoincidence * bounding_box_diagonal(cage.points);
  const FacetLocator<Dim> locator(cage, tolerance);
  const auto num_points = static_cast<Index>(points.cols());
  std::vector<FacetPlace<Dim>> places(num_points);
#pragma omp parallel for schedule(static)
  for (Index p = 0; p < num_points; ++p) places[p] = locator.locate(points.col(p));

  std::vector<KnownWeights<Dim>> known;
  for (Index p = 0; p < num_points; ++p) {
    if (places[p].facet < 0) continue;
    known.push_back({p, cage.facets.col(places[p].facet), places[p].coordinates});
    for (const Index i : known.back().control_points) {
      if ((cage.points.col(i) - points.col(p)).norm() <= tolerance) {
        known.back().coinciding_with = i;
      }
    }
  }
  return known;
}

// The mesh may have been made by anyone: its boundary vertices are on the cage by topology and are
// measured there even if rounding in a file has moved them a little.
template <int Dim>
std::vector<KnownWeights<Dim>> to_known_weights(const BoundaryValues<Dim>& boundary) {
  std::vector<KnownWeights<Dim>> known;
  for (std::size_t b = 0; b < boundary.vertices.size(); ++b) {
    known.push_back({boundary.vertices[b], boundary.control_points.col(b), boundary.values.col(b)});
  }
  for (std::size_t i = 0; i < boundary.control_vertices.size(); ++i) {
    known[boundary.boundary_index[boundary.control_vertices[i]]].coinciding_with =
        static_cast<Index>(i);
  }
  return known;
}

template <int Dim>
WeightCheck<Dim> check_at_points(const Cage<Dim>& cage, const PointList<Dim>& points,
                                 const WeightMatrix& weights,
                                 const std::vector<KnownWeights<Dim>>& known) {
  const double size = bounding_box_diagonal(cage.points);
  const auto num_points = static_cast<Index>(points.cols());
  const auto extremes =
      parallel_sum(num_points, WeightExtremes<Dim>(), [&](Index begin, Index end) {
        WeightExtremes<Dim> part;
        for (Index p = begin; p < end; ++p)
          add_point<Dim>(part, cage, size, p, points.col(p), weights);
        return part;
      });

  WeightCheck<Dim> check;
  check.points = num_points;
  check.control_points = cage.size();
  check.non_finite = extremes.non_finite;
  check.first_non_finite = extremes.first_non_finite;
  check.negative = extremes.negative;
  check.min_weight = extremes.min_weight;
  check.max_weight = extremes.max_weight;
  check.partition = extremes.partition;
  check.reproduction = extremes.reproduction;
  check.influences = extremes.most_influences;
  check.quality.min_weight = extremes.min_weight.value;
  check.quality.max_partition_error = extremes.partition.value;
  check.quality.max_reproduction_error = extremes.reproduction.value;
  check.quality.mean_influences =
      static_cast<double>(extremes.influences) /
      static_cast<double>(std::max<std::int64_t>(1, extremes.finite_points));
  measure_known_weights(check, points, weights, known);
  return check;
}

}  // namespace

template <int Dim>
WeightCheck<Dim> check_weights(const Cage<Dim>& cage, const PointList<Dim>& points,
                               const WeightMatrix& weights) {
  check_size(weights, cage.size(), points.cols());
  return check_at_points(cage, points, weights, find_points_on_cage(cage, points));
}

template <int Dim>
WeightCheck<Dim> check_weights(const Cage<Dim>& cage, const DomainMesh<Dim>& domain,
                               const WeightMatrix& weights) {
  check_size(weights, cage.size(), domain.num_vertices());
  const auto problem = make_geometry(cage, domain);  // which may have several parts
  auto check = check_at_points(cage, domain.points, weights, to_known_weights(problem.boundary));
  check.mesh = check_on_mesh(problem, domain, weights, check.quality.mean_influences);
  return check;
}

#define FLBC_INSTANTIATE(Dim)                                                       \
  template WeightCheck<Dim> check_weights(const Cage<Dim>&, const PointList<Dim>&,  \
                                          const WeightMatrix&);                     \
  template WeightCheck<Dim> check_weights(const Cage<Dim>&, const DomainMesh<Dim>&, \
                                          const WeightMatrix&);
FLBC_INSTANTIATE(2)
FLBC_INSTANTIATE(3)
#undef FLBC_INSTANTIATE

}  // namespace flbc
