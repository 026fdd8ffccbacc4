// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/placement.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include <Eigen/LU>

#include "base/instantiate.h"
#include "base/messages.h"
#include "base/parallel.h"
#include "base/shape_checks.h"
#include "cage/point_in_cage.h"
#include "flbc/bounding_box.h"
#include "flbc/cage.h"
#include "flbc/cage_facts.h"
#include "flbc/cell_locator.h"
#include "flbc/deform.h"
#include "flbc/errors.h"
#include "linear/dense.h"
#include "mesh/cell_geometry.h"
#include "placement/nearest_simplex.h"
#include "placement/place_on_cage.h"

namespace flbc {
namespace {

// The linear part of the affine least-squares fit of control point displacements: the G of least
// norm with sum_i G_i = 0 and sum_i c_i G_i^T = I.
template <int Dim>
struct AffineFit {
  std::vector<Index> control_points;
  Eigen::Matrix<double, Eigen::Dynamic, Dim> gradients;  //!< G, one row per control point
};

// Minimum ratio of smallest to largest extent of the control points, squared. Flatter sets would
// amplify small displacements far from their plane.
constexpr double kLeastExtent = 0.04;

template <int Dim>
PointList<Dim> centered(const PointList<Dim>& points, const std::vector<Index>& chosen) {
  PointList<Dim> some = points(Eigen::all, chosen);
  const Vector<Dim> center = some.rowwise().mean();
  return some.colwise() - center;
}

template <int Dim>
bool surrounds(const PointList<Dim>& offsets) {
  const Eigen::Matrix<double, Dim, Dim> moments = dense::moments<Dim>(offsets);
  const Eigen::Matrix<double, Dim, Dim> axes = dense::principal_axes<Dim>(moments);
  const Vector<Dim> extents = (axes.transpose() * moments * axes).diagonal();
  return extents.minCoeff() > kLeastExtent * extents.maxCoeff();
}

// Fits a control point together with its neighbors on the cage. Neighbors of neighbors are added
// until the set is not too flat, for example in coplanar facets.
template <int Dim>
class AffineFitter {
 public:
  // \param cage  valid; must outlive the fitter
  explicit AffineFitter(const Cage<Dim>& cage) : cage_(cage), neighbors_(cage.size()) {
    for (Index f = 0; f < cage.facets.cols(); ++f) {
      for (int j = 0; j < Dim; ++j) {
        for (int k = 0; k < Dim; ++k) {
          if (j != k) neighbors_[cage.facets(j, f)].push_back(cage.facets(k, f));
        }
      }
    }
  }

  AffineFit<Dim> operator()(Index control_point) const {
    std::vector<Index> chosen{control_point};
    std::vector<bool> is_chosen(cage_.size(), false);
    is_chosen[control_point] = true;
    PointList<Dim> offsets;
    std::size_t before = 0;
    do {
      const std::size_t end = chosen.size();
      for (std::size_t k = before; k < end; ++k) {
        for (const Index neighbor : neighbors_[chosen[k]]) {
          if (is_chosen[neighbor]) continue;
          is_chosen[neighbor] = true;
          chosen.push_back(neighbor);
        }
      }
      before = end;
      offsets = centered<Dim>(cage_.points, chosen);
    } while (!surrounds<Dim>(offsets) && chosen.size() > before);
    const Eigen::Matrix<double, Dim, Dim> moments = dense::moments<Dim>(offsets);
    return {std::move(chosen), offsets.transpose() * moments.inverse()};
  }

 private:
  const Cage<Dim>& cage_;
  std::vector<std::vector<Index>> neighbors_;
};

constexpr double kRounding = 1e-12;  // fraction of cage size within which a point is in a cell

// Leaves cell -1 for points that are not inside.
template <int Dim>
Location<Dim> locate(const CellLocator<Dim>& locator, const DomainMesh<Dim>& mesh,
                     const Vector<Dim>& point, double size) {
  auto location = locator.locate(point, kBoundaryTolerance * size);
  if (location.cell < 0 || location.coordinates.minCoeff() >= 0) return location;
  const auto geometry = cell_geometry(mesh, location.cell);
  if (distance_beyond<Dim>(location.coordinates, geometry.hat_gradients) > kRounding * size) {
    return {};
  }
  location.coordinates = location.coordinates.cwiseMax(0);
  location.coordinates /= location.coordinates.sum();
  return location;
}

template <int Dim>
void refuse_outside(const Placement<Dim>& placement, const PointList<Dim>& points, double size) {
  const auto& outside = placement.outside;
  const auto farthest =
      std::max_element(outside.begin(), outside.end(),
                       [](const auto& a, const auto& b) { return a.distance() < b.distance(); });
  throw InputError(
      std::to_string(outside.size()) + " of " + std::to_string(points.cols()) +
      " vertices are outside the cage; the farthest is vertex " + std::to_string(farthest->point) +
      " at " + format_point(points.col(farthest->point)) + ", " +
      format_number(farthest->distance()) + " from it, " +
      format_number(100 * farthest->distance() / size) +
      "% of the cage size; choose OutsidePoints kNearest, kKeep, or kExtend, or make a cage around "
      "the model with cage_from_model()");
}

// Lists the points that are not inside, and moves them onto the cage where that is due.
// \param is_inside  (point, place), where it may set the place
template <int Dim, class IsInside>
Placement<Dim> place_all(const Cage<Dim>& cage, const PointList<Dim>& points, OutsidePoints policy,
                         const IsInside& is_inside) {
  const auto num_points = static_cast<Index>(points.cols());
  Placement<Dim> placement;
  placement.policy = policy;
  placement.points = points;
  placement.places.resize(static_cast<std::size_t>(num_points));
  std::vector<char> inside(static_cast<std::size_t>(num_points));
  parallel_for(num_points, [&](Index p) { inside[p] = is_inside(p, placement.places[p]); });
  std::vector<Index> not_inside;
  for (Index p = 0; p < num_points; ++p) {
    if (!inside[p]) not_inside.push_back(p);
  }
  const double size = bounding_box_diagonal(cage.points);
  for (const auto& point : nearest_on_cage(cage, points, not_inside)) {
    const bool is_near = point.distance() <= kBoundaryTolerance * size;
    (is_near ? placement.on_cage : placement.outside).push_back(point);
    if (is_near || policy == OutsidePoints::kNearest) {
      placement.points.col(point.point) = place_on_cage(cage, point);
    }
  }
  if (policy == OutsidePoints::kFail && !placement.outside.empty()) {
    refuse_outside(placement, points, size);
  }
  return placement;
}

// Evaluates the weights of one placed point at a time.
template <int Dim>
class WeightsAt {
 public:
  using Inside = std::function<Eigen::VectorXd(Index point)>;

  // \param inside  for points inside
  WeightsAt(const Cage<Dim>& cage, const Placement<Dim>& placement, Inside inside)
      : cage_(cage), placement_(placement), inside_(std::move(inside)) {
    check_placement(cage, placement);
    const auto policy = placement.policy;
    for (const auto& nearest : placement.on_cage) {
      attached_[nearest.point] = {&nearest, OutsidePoints::kNearest};
    }
    for (const auto& nearest : placement.outside) attached_[nearest.point] = {&nearest, policy};
    if (policy == OutsidePoints::kExtend) fit_round_facets();
  }

  Eigen::VectorXd operator()(Index point) const {
    const auto found = attached_.find(point);
    if (found == attached_.end()) return inside_(point);
    const auto& [nearest, policy] = found->second;
    Eigen::VectorXd result = Eigen::VectorXd::Zero(cage_.size());
    if (policy == OutsidePoints::kKeep) return result;
    for (int k = 0; k < Dim; ++k) {
      result[cage_.facets(k, nearest->facet)] = nearest->coordinates[k];
    }
    if (policy == OutsidePoints::kExtend) extend(*nearest, result);
    return result;
  }

 private:
  struct Attachment {
    const NearestOnCage<Dim>* place = nullptr;
    OutsidePoints policy = OutsidePoints::kNearest;
  };

  void fit_round_facets() {
    const AffineFitter<Dim> fitter(cage_);
    for (const auto& nearest : placement_.outside) {
      for (int k = 0; k < Dim; ++k) {
        const Index corner = cage_.facets(k, nearest.facet);
        if (nearest.coordinates[k] != 0 && !fits_.count(corner)) {
          fits_.emplace(corner, fitter(corner));
        }
      }
    }
  }

  // Adds sum_k b_k G_k (x - q) with the affine fits G_k at the corners of the facet.
  void extend(const NearestOnCage<Dim>& nearest, Eigen::VectorXd& result) const {
    for (int k = 0; k < Dim; ++k) {
      if (nearest.coordinates[k] == 0) continue;
      const auto& fit = fits_.at(cage_.facets(k, nearest.facet));
      for (std::size_t i = 0; i < fit.control_points.size(); ++i) {
        result[fit.control_points[i]] +=
            nearest.coordinates[k] * fit.gradients.row(i).dot(nearest.offset);
      }
    }
  }

  const Cage<Dim>& cage_;
  const Placement<Dim>& placement_;
  Inside inside_;
  std::unordered_map<Index, Attachment> attached_;
  std::map<Index, AffineFit<Dim>> fits_;
};

// Whether all control points that move a point are corners of facets within a distance from it. A
// mirror puts a point between two facets that are equally near.
template <int Dim>
bool follows_facets(const Cage<Dim>& cage, const PointList<Dim>& points, Index p,
                    Eigen::VectorXd weights, double distance) {
  for (const auto& facet : cage.facets.colwise()) {
    if ((weights(facet).array() == 0).all()) continue;
    const Cage<Dim> alone{cage.points, facet};
    if (nearest_on_cage(alone, points, {p})[0].distance() <= distance) weights(facet).setZero();
  }
  return (weights.array() == 0).all();
}

}  // namespace

template <int Dim>
std::vector<NearestOnCage<Dim>> nearest_on_cage(const Cage<Dim>& cage, const PointList<Dim>& points,
                                                const std::vector<Index>& which) {
  check_elements(cage.points, cage.facets, kCageNames);
  check_finite<Dim>(points);
  for (const Index p : which) {
    if (p < 0 || p >= points.cols()) {
      throw InputError("there is no point " + std::to_string(p) + " among " +
                       std::to_string(points.cols()) + " points");
    }
  }
  std::vector<NearestOnCage<Dim>> result(which.size());
  const NearestSimplex<Dim, Dim> nearest(cage.points, cage.facets);
  const auto count = static_cast<Index>(which.size());
  parallel_for(count, [&](Index k) {
    HullPoint<Dim> place{};
    const Index facet = nearest(points.col(which[k]), place);
    result[k] = {which[k], facet};
    for (int c = 0; c < place.size; ++c) result[k].coordinates[place.support[c]] = place.weights[c];
    result[k].offset = points.col(which[k]) - place_on_cage(cage, result[k]);
  });
  return result;
}

template <int Dim>
Placement<Dim> place_points(const Cage<Dim>& cage, const DomainMesh<Dim>& mesh,
                            const PointList<Dim>& points, OutsidePoints policy) {
  return place_points(cage, mesh, CellLocator<Dim>(mesh), points, policy);
}

template <int Dim>
Placement<Dim> place_points(const Cage<Dim>& cage, const DomainMesh<Dim>& mesh,
                            const CellLocator<Dim>& locator, const PointList<Dim>& points,
                            OutsidePoints policy) {
  check_elements(cage.points, cage.facets, kCageNames);
  check_finite<Dim>(points);
  const double size = bounding_box_diagonal(cage.points);
  return place_all(cage, points, policy, [&](Index p, Location<Dim>& place) {
    place = locate<Dim>(locator, mesh, points.col(p), size);
    return place.cell >= 0;
  });
}

template <int Dim>
Placement<Dim> place_points(const Cage<Dim>& cage, const PointList<Dim>& points,
                            OutsidePoints policy) {
  check_finite<Dim>(points);
  const CageLocator<Dim> locator(cage, kRounding * bounding_box_diagonal(cage.points));
  return place_all(cage, points, policy,
                   [&](Index p, Location<Dim>&) { return !locator.is_outside(points.col(p)); });
}

template <int Dim>
OutsidePoints usual_policy(const Cage<Dim>& cage, const PointList<Dim>& points,
                           const EdgeList& edges) {
  validate(edges, points.cols());
  std::vector<bool> has_edge(static_cast<std::size_t>(points.cols()), false);
  for (const auto& ends : edges.ends) has_edge[ends[0]] = has_edge[ends[1]] = true;
  const auto outside = points_outside(cage, points);
  const bool are_loose =
      std::none_of(outside.begin(), outside.end(), [&](Index p) { return has_edge[p]; });
  return are_loose && !outside.empty() && !edges.ends.empty() ? OutsidePoints::kNearest
                                                              : OutsidePoints::kFail;
}

template <int Dim>
PointList<Dim> attached_points(const Cage<Dim>& cage, const PointList<Dim>& points,
                               const SparseWeights& weights) {
  check_size(weights, cage.size(), points.cols());
  const double tolerance = kBoundaryTolerance * bounding_box_diagonal(cage.points);
  const auto reproduced = deform<Dim>(weights, cage.points);
  std::vector<Index> elsewhere;
  for (Index p = 0; p < weights.num_points() && cage.facets.cols() > 0; ++p) {
    if (!weights.has_weights(p)) continue;
    if ((reproduced.col(p) - points.col(p)).norm() > tolerance) elsewhere.push_back(p);
  }
  if (elsewhere.empty()) return points;
  const CageLocator<Dim> locator(cage, tolerance);
  PointList<Dim> result = points;
  for (const auto& nearest : nearest_on_cage(cage, points, elsewhere)) {
    const Index p = nearest.point;
    // By the distance, because several points of the cage may be equally near.
    const double error = (reproduced.col(p) - points.col(p)).norm(),
                 limit = nearest.distance() + tolerance;
    if (error > limit) continue;
    if (error < nearest.distance() - tolerance &&
        !follows_facets(cage, points, p, weights.at(p), limit)) {
      continue;
    }
    if (locator.is_outside(points.col(p))) result.col(p) = reproduced.col(p);
  }
  return result;
}

template <int Dim>
SparseWeights weights_at(const Cage<Dim>& cage, const DomainMesh<Dim>& mesh,
                         const SparseWeights& weights, const Placement<Dim>& placement) {
  check_indices(mesh.cells, mesh.num_vertices(), kMeshNames);
  check_size(weights, cage.size(), mesh.num_vertices());
  const auto inside = [&](Index p) { return interpolate(mesh, weights, placement.places[p]); };
  return SparseWeights::of(cage.size(), static_cast<Index>(placement.places.size()),
                           WeightsAt<Dim>(cage, placement, inside));
}

template <int Dim>
SparseWeights weights_at(const Cage<Dim>& cage, const SparseWeights& weights,
                         const Placement<Dim>& placement) {
  check_size(weights, cage.size(), static_cast<Eigen::Index>(placement.places.size()));
  const auto inside = [&](Index p) { return weights.at(p); };
  return SparseWeights::of(cage.size(), static_cast<Index>(placement.places.size()),
                           WeightsAt<Dim>(cage, placement, inside));
}

#define FLBC_INSTANTIATE(Dim)                                                          \
  template SparseWeights weights_at(const Cage<Dim>&, const DomainMesh<Dim>&,          \
                                    const SparseWeights&, const Placement<Dim>&);      \
  template SparseWeights weights_at(const Cage<Dim>&, const SparseWeights&,            \
                                    const Placement<Dim>&);                            \
  template Placement<Dim> place_points(const Cage<Dim>&, const DomainMesh<Dim>&,       \
                                       const PointList<Dim>&, OutsidePoints);          \
  template Placement<Dim> place_points(const Cage<Dim>&, const DomainMesh<Dim>&,       \
                                       const CellLocator<Dim>&, const PointList<Dim>&, \
                                       OutsidePoints);                                 \
  template Placement<Dim> place_points(const Cage<Dim>&, const PointList<Dim>&, OutsidePoints);
FLBC_INSTANTIATE(2)
FLBC_INSTANTIATE(3)
#undef FLBC_INSTANTIATE
FLBC_INSTANTIATE_FUNCTION(nearest_on_cage)
FLBC_INSTANTIATE_FUNCTION(usual_policy)
FLBC_INSTANTIATE_FUNCTION(attached_points)

}  // namespace flbc
