// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/placement.h"

#include <algorithm>
#include <map>
#include <string>

#include "base/messages.h"
#include "coordinates/affine_fit.h"
#include "flbc/boundary_tolerance.h"
#include "flbc/bounding_box.h"
#include "flbc/errors.h"
#include "flbc/interpolate.h"
#include "mesh/cell_geometry.h"
#include "projection/nearest_point_in_hull.h"

namespace flbc {
namespace {

constexpr double kRounding = 1e-12;  // of the cage's size: a point that near a cell is in it

// The place on a cage nearest to a point.
template <int Dim>
class NearestOnCage {
 public:
  explicit NearestOnCage(const Cage<Dim>& cage) {
    for (Index f = 0; f < cage.facets.cols(); ++f) {
      PointList<Dim> corners(Dim, Dim);
      for (int k = 0; k < Dim; ++k) corners.col(k) = cage.points.col(cage.facets(k, f));
      facets_.push_back(
          {corners, corners.rowwise().minCoeff(), corners.rowwise().maxCoeff()});
    }
  }

  PointBeside<Dim> operator()(Index number, const Vector<Dim>& point) const {
    PointBeside<Dim> nearest;
    nearest.point = number;
    for (std::size_t f = 0; f < facets_.size(); ++f) {
      const auto& [corners, low, high] = facets_[f];
      const Vector<Dim> in_box = point.cwiseMax(low).cwiseMin(high);
      if (nearest.facet >= 0 && (in_box - point).norm() >= nearest.distance) continue;
      const auto place = nearest_point_in_hull<Dim>(corners, point);
      if (nearest.facet >= 0 && place.distance >= nearest.distance) continue;
      nearest.facet = static_cast<Index>(f);
      nearest.distance = place.distance;
      nearest.coordinates.setZero();
      for (int k = 0; k < place.size; ++k) nearest.coordinates[place.support[k]] = place.weights[k];
    }
    return nearest;
  }

 private:
  struct Facet {
    PointList<Dim> corners;
    Vector<Dim> low, high;
  };
  std::vector<Facet> facets_;
};

template <int Dim>
Vector<Dim> place_on_cage(const Cage<Dim>& cage, const PointBeside<Dim>& beside) {
  Vector<Dim> place = Vector<Dim>::Zero();
  for (int k = 0; k < Dim; ++k) {
    place += beside.coordinates[k] * cage.points.col(cage.facets(k, beside.facet));
  }
  return place;
}

// How far a point is beyond the facets of its cell.
template <int Dim>
double distance_beyond(const DomainMesh<Dim>& mesh, const Location<Dim>& location) {
  if (location.coordinates.minCoeff() >= 0) return 0;
  const auto geometry = cell_geometry(mesh, location.cell);
  double distance = 0;
  for (int k = 0; k <= Dim; ++k) {
    // A coordinate below zero, times the height over its facet.
    distance =
        std::max(distance, -location.coordinates[k] / geometry.hat_gradients.col(k).norm());
  }
  return distance;
}

// Leaves cell -1 for points that are not inside.
template <int Dim>
Location<Dim> locate(const CellLocator<Dim>& locator, const DomainMesh<Dim>& mesh,
                     const Vector<Dim>& point, double size) {
  auto location = locator.locate(point, kBoundaryTolerance * size);
  if (location.cell < 0) return location;
  if (distance_beyond(mesh, location) > kRounding * size) return {};
  if (location.coordinates.minCoeff() < 0) {
    location.coordinates = location.coordinates.cwiseMax(0);
    location.coordinates /= location.coordinates.sum();
  }
  return location;
}

template <int Dim>
void refuse_outside(const Placement<Dim>& placement, const PointList<Dim>& points, double size) {
  const auto& outside = placement.outside;
  const auto farthest =
      std::max_element(outside.begin(), outside.end(), [](const auto& a, const auto& b) {
        return a.distance < b.distance;
      });
  throw InputError(
      std::to_string(outside.size()) + " of " + std::to_string(points.cols()) +
      " points lie outside the cage, the farthest is vertex " + std::to_string(farthest->point) +
      " at " + format_point(points.col(farthest->point)) + ", " +
      format_number(farthest->distance) + " from it, " +
      format_number(100 * farthest->distance / size) +
      " % of its size; give them weights by --outside nearest or --outside extend, or make a cage "
      "round the model with flbc cage");
}

template <int Dim>
void set_facet_weights(const Cage<Dim>& cage, const PointBeside<Dim>& beside,
                       Eigen::Ref<Eigen::VectorXd> weights) {
  weights.setZero();
  for (int k = 0; k < Dim; ++k) {
    weights[cage.facets(k, beside.facet)] = beside.coordinates[k];
  }
}

// Adds sum_k b_k G_k (x - q) with the affine fits G_k at the corners of the facet.
template <int Dim>
void extend(const Cage<Dim>& cage, const Placement<Dim>& placement, WeightMatrix& weights) {
  const AffineFitter<Dim> fitter(cage);
  std::map<Index, AffineFit<Dim>> fits;
  for (const auto& beside : placement.outside) {
    const Vector<Dim> offset =
        placement.points.col(beside.point) - place_on_cage(cage, beside);
    for (int k = 0; k < Dim; ++k) {
      if (beside.coordinates[k] == 0) continue;
      const Index corner = cage.facets(k, beside.facet);
      const auto found = fits.find(corner);
      const auto& fit =
          found != fits.end() ? found->second : fits.emplace(corner, fitter(corner)).first->second;
      for (std::size_t i = 0; i < fit.control_points.size(); ++i) {
        weights(fit.control_points[i], beside.point) +=
            beside.coordinates[k] * fit.gradients.row(i).dot(offset);
      }
    }
  }
}

}  // namespace

template <int Dim>
std::vector<PointBeside<Dim>> nearest_on_cage(const Cage<Dim>& cage, const PointList<Dim>& points,
                                              const std::vector<Index>& which) {
  std::vector<PointBeside<Dim>> result(which.size());
  const NearestOnCage<Dim> nearest(cage);
  const auto count = static_cast<Index>(which.size());
#pragma omp parallel for schedule(static)
  for (Index k = 0; k < count; ++k) result[k] = nearest(which[k], points.col(which[k]));
  return result;
}

template <int Dim>
Placement<Dim> place_points(const Cage<Dim>& cage, const DomainMesh<Dim>& mesh,
                            const PointList<Dim>& points, OutsidePoints policy) {
  const double size = bounding_box_diagonal(cage.points);
  const CellLocator<Dim> locator(mesh);
  const auto num_points = static_cast<Index>(points.cols());
  Placement<Dim> placement;
  placement.policy = policy;
  placement.points = points;
  placement.places.resize(static_cast<std::size_t>(num_points));
#pragma omp parallel for schedule(static)
  for (Index p = 0; p < num_points; ++p) {
    placement.places[p] = locate<Dim>(locator, mesh, points.col(p), size);
  }
  std::vector<Index> beside;
  for (Index p = 0; p < num_points; ++p) {
    if (placement.places[p].cell < 0) beside.push_back(p);
  }
  for (const auto& point : nearest_on_cage(cage, points, beside)) {
    const bool is_near = point.distance <= kBoundaryTolerance * size;
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

template <int Dim>
WeightMatrix weights_at(const Cage<Dim>& cage, const DomainMesh<Dim>& mesh,
                        const WeightMatrix& weights, const Placement<Dim>& placement) {
  auto places = placement.places;
  for (auto& place : places) {  // those not inside get their weights below
    if (place.cell >= 0) continue;
    place.cell = 0;
    place.coordinates.setZero();
  }
  auto result = interpolate(mesh, weights, places);
  for (const auto& point : placement.on_cage) {
    set_facet_weights<Dim>(cage, point, result.col(point.point));
  }
  for (const auto& point : placement.outside) {
    set_facet_weights<Dim>(cage, point, result.col(point.point));
  }
  if (placement.policy == OutsidePoints::kExtend) extend(cage, placement, result);
  return result;
}

#define FLBC_INSTANTIATE(Dim)                                                              \
  template std::vector<PointBeside<Dim>> nearest_on_cage(                                  \
      const Cage<Dim>&, const PointList<Dim>&, const std::vector<Index>&);                 \
  template Placement<Dim> place_points(const Cage<Dim>&, const DomainMesh<Dim>&,           \
                                       const PointList<Dim>&, OutsidePoints);              \
  template WeightMatrix weights_at(const Cage<Dim>&, const DomainMesh<Dim>&,               \
                                   const WeightMatrix&, const Placement<Dim>&);
FLBC_INSTANTIATE(2)
FLBC_INSTANTIATE(3)
#undef FLBC_INSTANTIATE

}  // namespace flbc
