// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/check.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "base/instantiate.h"
#include "base/messages.h"
#include "base/parallel.h"
#include "base/shape_checks.h"
#include "cage/facet_locator.h"
#include "flbc/bounding_box.h"
#include "flbc/harmonic.h"
#include "flbc/lbc_problem.h"
#include "flbc/placement.h"
#include "flbc/quality.h"
#include "flbc/sparsify_error.h"
#include "mesh/vertex_cells.h"
#include "problem/problem_geometry.h"

namespace flbc {
namespace {

// Keeps the larger value; the first of equal values is kept.
template <int Dim>
void keep_larger(Extreme<Dim>& best, const Extreme<Dim>& other) {
  if (other.point >= 0 && (best.point < 0 || other.value > best.value)) best = other;
}

template <int Dim>
void keep_smaller(Extreme<Dim>& best, const Extreme<Dim>& other) {
  if (other.point >= 0 && (best.point < 0 || other.value < best.value)) best = other;
}

constexpr double kExtremumMargin = 1e-6;

// Extrema found in a part of the mesh; parts are summed in the order of vertices.
template <int Dim>
struct Extrema {
  Eigen::Matrix<Index, Eigen::Dynamic, 1> minima, maxima;  // n
  Extreme<Dim> deepest, highest;

  explicit Extrema(Index n) : minima(n), maxima(n) {
    minima.setZero();
    maxima.setZero();
  }
  Extrema& operator+=(const Extrema& next) {
    minima += next.minima;
    maxima += next.maxima;
    keep_larger(deepest, next.deepest);
    keep_larger(highest, next.highest);
    return *this;
  }
};

// Each neighbor once, because cells share them.
template <int Dim>
void collect_neighbours(const DomainMesh<Dim>& mesh, const VertexCells& around, Index vertex,
                        std::vector<Index>& neighbours) {
  neighbours.clear();
  for (const Index s : around.cells_of(vertex)) {
    for (const Index v : mesh.cells.col(s)) {
      if (v != vertex) neighbours.push_back(v);
    }
  }
  std::sort(neighbours.begin(), neighbours.end());
  neighbours.erase(std::unique(neighbours.begin(), neighbours.end()), neighbours.end());
}

template <int Dim>
Extrema<Dim> find_extrema(const DomainMesh<Dim>& mesh, const std::vector<Index>& interior,
                          const WeightMatrix& weights) {
  const VertexCells around(mesh);
  const auto n = static_cast<Index>(weights.rows());
  const auto search = [&](Index begin, Index end) {
    Extrema<Dim> found(n);
    std::vector<Index> neighbours;
    Eigen::ArrayXd lowest, highest;
    for (Index k = begin; k < end; ++k) {
      const Index v = interior[k];
      const Vector<Dim> place = mesh.points.col(v);
      collect_neighbours(mesh, around, v, neighbours);
      lowest = highest = weights.col(neighbours.front());
      for (const Index w : neighbours) {
        lowest = lowest.min(weights.col(w).array());
        highest = highest.max(weights.col(w).array());
      }
      for (Index i = 0; i < n; ++i) {
        const double depth = lowest[i] - weights(i, v);
        const double height = weights(i, v) - highest[i];
        if (depth > kExtremumMargin) {
          ++found.minima[i];
          keep_larger(found.deepest, {depth, v, i, place});
        }
        if (height > kExtremumMargin) {
          ++found.maxima[i];
          keep_larger(found.highest, {height, v, i, place});
        }
      }
    }
    return found;
  };
  return parallel_sum(static_cast<Index>(interior.size()), Extrema<Dim>(n), search);
}

// The objective in the units of the mesh. \param problem  with phi
template <int Dim>
double weighted_variation(const LbcProblem<Dim>& problem, const SparseWeights& weights) {
  return objective(problem.mesh, problem.phi, weights) / std::pow(problem.scale, Dim - 1);
}

// \param problem  made of the mesh
// \param domain  the mesh, in its own units
// \param dense  the same weights
// \param mean_influences  of the weights
template <int Dim>
MeshCheck<Dim> check_on_mesh(LbcProblem<Dim> problem, const DomainMesh<Dim>& domain,
                             const SparseWeights& weights, const WeightMatrix& dense,
                             double mean_influences) {
  const auto interior = problem.boundary.interior_vertices();
  MeshCheck<Dim> check;
  check.interior_vertices = static_cast<Index>(interior.size());
  const auto extrema = find_extrema(domain, interior, dense);
  check.local_minima.assign(extrema.minima.begin(), extrema.minima.end());
  check.local_maxima.assign(extrema.maxima.begin(), extrema.maxima.end());
  check.deepest_minimum = extrema.deepest;
  check.highest_maximum = extrema.highest;
  check.total_variation = total_variation(domain, weights);

  const SparseWeights harmonic = harmonic_coordinates(problem);
  check.harmonic_total_variation = total_variation(domain, harmonic);
  check.gradient_jump = gradient_jump(problem, weights);
  check.harmonic_gradient_jump = gradient_jump(problem, harmonic);
  if (count_parts(domain) == 1) {
    set_phi(problem, DistanceScheme::kSquare);
    check.weighted_variation = weighted_variation(problem, weights);
    check.harmonic_weighted_variation = weighted_variation(problem, harmonic);
  }
  check.harmonic_mean_influences = count_influences(harmonic, kInfluenceThreshold).mean;
  check.influence_ratio = mean_influences / check.harmonic_mean_influences;
  return check;
}

constexpr double kCoincidence = 1e-10;  // fraction of cage size within which points coincide
constexpr double kRounding = 1e-12;     // tolerance for negative weights

// Counts and extremes of weights; parts are summed in the order of points.
template <int Dim>
struct WeightExtremes {
  PointCheck<Dim> check;  // check to which these extremes belong
  std::int64_t influences = 0, finite_points = 0;

  WeightExtremes& operator+=(const WeightExtremes& other) {
    influences += other.influences;
    finite_points += other.finite_points;
    const PointCheck<Dim>& next = other.check;
    check.non_finite += next.non_finite;
    check.without_weights += next.without_weights;
    check.negative += next.negative;
    if (check.first_non_finite.point < 0) check.first_non_finite = next.first_non_finite;
    keep_smaller(check.min_weight, next.min_weight);
    keep_larger(check.max_weight, next.max_weight);
    keep_larger(check.partition, next.partition);
    keep_larger(check.reproduction, next.reproduction);
    keep_larger(check.influences, next.influences);
    return *this;
  }
};

// \param may_be_still  whether points without weights are right
template <int Dim>
void add_point(WeightExtremes<Dim>& extremes, const Cage<Dim>& cage, double size, Index p,
               const Vector<Dim>& place, const WeightMatrix& weights, bool may_be_still) {
  PointCheck<Dim>& check = extremes.check;
  const auto column = weights.col(p);
  if (!column.allFinite()) {
    for (Index i = 0; i < column.size(); ++i) {
      if (std::isfinite(column[i])) continue;
      ++check.non_finite;
      if (check.first_non_finite.point < 0) check.first_non_finite = {column[i], p, i, place};
    }
    return;
  }
  ++extremes.finite_points;
  Index lowest = 0, highest = 0;
  const double least = column.minCoeff(&lowest);
  const double most = column.maxCoeff(&highest);
  const auto influences = (column.array().abs() > kInfluenceThreshold).count();
  const Vector<Dim> error = cage.points * column - place;
  if (column.isZero(0)) {
    ++check.without_weights;
    if (may_be_still) return keep_smaller(check.min_weight, {0, p, 0, place});
  }
  check.negative += (column.array() < -kRounding).count();
  extremes.influences += influences;
  keep_smaller(check.min_weight, {least, p, lowest, place});
  keep_larger(check.max_weight, {most, p, highest, place});
  keep_larger(check.partition, {std::abs(column.sum() - 1), p, -1, place});
  keep_larger(check.reproduction, {error.norm() / size, p, -1, place});
  keep_larger(check.influences, {static_cast<double>(influences), p, -1, place});
}

// A point on the cage and the weights that it must have.
template <int Dim>
struct KnownWeights {
  Index point;
  Eigen::Matrix<Index, Dim, 1> control_points;
  Vector<Dim> values;          //!< their weights; all others are 0
  Index coinciding_with = -1;  //!< the control point at this point; -1: none
};

template <int Dim>
void measure_known_weights(PointCheck<Dim>& check, const PointList<Dim>& points,
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
  parallel_for(num_points, [&](Index p) { places[p] = locator.locate(points.col(p)); });

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

// The mesh may come from a file with rounded coordinates, so boundary vertices are identified by
// topology and measured as points on the cage.
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
                                 const std::vector<KnownWeights<Dim>>& known, bool may_be_still) {
  const double size = bounding_box_diagonal(cage.points);
  const auto num_points = static_cast<Index>(points.cols());
  const auto extremes =
      parallel_sum(num_points, WeightExtremes<Dim>(), [&](Index begin, Index end) {
        WeightExtremes<Dim> part;
        for (Index p = begin; p < end; ++p)
          add_point<Dim>(part, cage, size, p, points.col(p), weights, may_be_still);
        return part;
      });

  WeightCheck<Dim> check{extremes.check};
  check.points = num_points;
  check.control_points = cage.size();
  check.quality.min_weight = check.min_weight.value;
  check.quality.max_partition_error = check.partition.value;
  check.quality.max_reproduction_error = check.reproduction.value;
  check.quality.mean_influences =
      static_cast<double>(extremes.influences) /
      static_cast<double>(std::max<std::int64_t>(1, extremes.finite_points));
  measure_known_weights(check, points, weights, known);
  return check;
}

template <int Dim>
std::string point_of(const Extreme<Dim>& extreme) {
  return "point " + std::to_string(extreme.point) + " at " + format_point(extreme.place);
}

std::string weight_for(Index control_point) {
  return "the weight for control point " + std::to_string(control_point);
}

}  // namespace

template <int Dim>
WeightCheck<Dim> check_weights(const Cage<Dim>& cage, const PointList<Dim>& points,
                               const SparseWeights& weights) {
  check_size(weights, cage.size(), points.cols());
  const auto attached = attached_points(cage, points, weights);
  auto known = find_points_on_cage(cage, attached);
  const auto is_still = [&](const auto& at) { return !weights.has_weights(at.point); };
  known.erase(std::remove_if(known.begin(), known.end(), is_still), known.end());
  return check_at_points(cage, attached, weights.dense(), known, true);
}

template <int Dim>
WeightCheck<Dim> check_weights(const Cage<Dim>& cage, const DomainMesh<Dim>& domain,
                               const SparseWeights& weights) {
  validate(domain);
  check_size(weights, cage.size(), domain.num_vertices());
  auto problem = make_geometry(cage, domain);  // which may have several parts
  const auto dense = weights.dense();
  auto check =
      check_at_points(cage, domain.points, dense, to_known_weights(problem.boundary), false);
  check.mesh =
      check_on_mesh(std::move(problem), domain, weights, dense, check.quality.mean_influences);
  return check;
}

#define FLBC_INSTANTIATE(Dim)                                                       \
  template WeightCheck<Dim> check_weights(const Cage<Dim>&, const PointList<Dim>&,  \
                                          const SparseWeights&);                    \
  template WeightCheck<Dim> check_weights(const Cage<Dim>&, const DomainMesh<Dim>&, \
                                          const SparseWeights&);
FLBC_INSTANTIATE(2)
FLBC_INSTANTIATE(3)
#undef FLBC_INSTANTIATE

template <int Dim>
std::vector<std::string> find_violations(const WeightCheck<Dim>& check) {
  std::vector<std::string> violations;
  if (check.non_finite > 0) {
    const auto& first = check.first_non_finite;
    violations.push_back(std::to_string(check.non_finite) +
                         " weights are not finite; the first is " +
                         weight_for(first.control_point) + " at " + point_of(first));
  }
  const auto add = [&](const Extreme<Dim>& error, const std::string& before,
                       const std::string& after) {
    // NaN is also a violation.
    if (error.point < 0 || error.value <= kCheckTolerance) return;
    violations.push_back(before + format_number(error.value) + after);
  };
  add(check.partition,
      "the weights of " + point_of(check.partition) + " do not sum to 1, but differ from it by ",
      "");
  add(check.reproduction,
      "the weights of " + point_of(check.reproduction) + " do not reproduce it: sum w c is off by ",
      " of the cage size");
  add(check.lagrange,
      "at " + point_of(check.lagrange) + ", where a control point is, " +
          weight_for(check.lagrange.control_point) + " is off by ",
      " from the 1 or 0 that it must be there");
  add(check.linearity,
      "at " + point_of(check.linearity) + ", which is on the cage, " +
          weight_for(check.linearity.control_point) + " is off by ",
      " from linear interpolation in the facet");
  return violations;
}

FLBC_INSTANTIATE_FUNCTION(find_violations)

}  // namespace flbc
