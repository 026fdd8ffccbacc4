// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/evaluator.h"

#include <utility>
#include <vector>

#include "base/parallel.h"
#include "base/shape_checks.h"
#include "flbc/deform.h"
#include "mesh/check_place.h"
#include "placement/place_on_cage.h"

namespace flbc {
namespace {

constexpr double kBoxesPerCell = 8;  // for many points

// The outside points of a placement as a placement of their own.
template <int Dim>
Placement<Dim> outside_of(const Placement<Dim>& placement) {
  Placement<Dim> result;
  result.policy = placement.policy;
  result.outside = placement.outside;
  result.places.resize(placement.outside.size());
  result.points.resize(Dim, static_cast<Eigen::Index>(placement.outside.size()));
  for (std::size_t k = 0; k < placement.outside.size(); ++k) {
    auto& point = result.outside[k].point;
    result.points.col(static_cast<Eigen::Index>(k)) = placement.points.col(point);
    point = static_cast<Index>(k);
  }
  return result;
}

}  // namespace

template <int Dim>
struct Evaluator<Dim>::Parts {
  Cage<Dim> cage;
  DomainMesh<Dim> mesh;
  SparseWeights weights;
  OutsidePoints outside;
  int threads;
  CellLocator<Dim> locator{mesh, kBoxesPerCell};
};

template <int Dim>
Evaluator<Dim>::Evaluator(Cage<Dim> cage, DomainMesh<Dim> mesh, SparseWeights weights,
                          OutsidePoints outside, int threads) {
  check_elements(cage.points, cage.facets, kCageNames);
  check_size(weights, cage.size(), mesh.num_vertices());
  parts_.reset(new Parts{std::move(cage), std::move(mesh), std::move(weights), outside, threads});
}

template <int Dim>
Evaluator<Dim>::~Evaluator() = default;
template <int Dim>
Evaluator<Dim>::Evaluator(Evaluator&&) noexcept = default;

template <int Dim>
const Cage<Dim>& Evaluator<Dim>::cage() const {
  return parts_->cage;
}

template <int Dim>
Placement<Dim> Evaluator<Dim>::place(const PointList<Dim>& points) const {
  const ThreadScope scope(parts_->threads);
  return place_points(parts_->cage, parts_->mesh, parts_->locator, points, parts_->outside);
}

template <int Dim>
SparseWeights Evaluator<Dim>::weights(const Placement<Dim>& placement) const {
  const ThreadScope scope(parts_->threads);
  return weights_at(parts_->cage, parts_->mesh, parts_->weights, placement);
}

template <int Dim>
PosedDomain<Dim> Evaluator<Dim>::pose(const PointList<Dim>& control_points) const {
  return {control_points, deform(parts_->weights, control_points, parts_->threads)};
}

template <int Dim>
PointList<Dim> Evaluator<Dim>::move(const Placement<Dim>& placement,
                                    const PosedDomain<Dim>& pose) const {
  auto moved = displace(placement, pose);
  for (const auto& point : placement.outside) {
    if (placement.policy == OutsidePoints::kNearest) moved.col(point.point) += point.offset;
    if (placement.policy == OutsidePoints::kKeep) {
      moved.col(point.point) = placement.points.col(point.point);
    }
  }
  return moved;
}

template <int Dim>
PointList<Dim> Evaluator<Dim>::displace(const Placement<Dim>& placement,
                                        const PosedDomain<Dim>& pose) const {
  check_placement(parts_->cage, placement);
  check_size(pose.control_points.cols(), pose.vertices.cols(), parts_->cage.size(),
             parts_->mesh.num_vertices());
  const ThreadScope scope(parts_->threads);
  const auto count = static_cast<Index>(placement.places.size());
  PointList<Dim> moved(Dim, count);
  const auto& cells = parts_->mesh.cells;
  parallel_for(count, [&](Index p) {
    const auto& [cell, coordinates] = placement.places[p];
    if (cell < 0) return;
    check_place(parts_->mesh, parts_->mesh.num_vertices(), placement.places[p]);
    Vector<Dim> sum = coordinates[0] * pose.vertices.col(cells(0, cell));
    for (int k = 1; k <= Dim; ++k) sum += coordinates[k] * pose.vertices.col(cells(k, cell));
    moved.col(p) = sum;
  });
  const Cage<Dim> posed_cage{pose.control_points, parts_->cage.facets};
  const auto follow_nearest = [&](const std::vector<NearestOnCage<Dim>>& points) {
    for (const auto& point : points) moved.col(point.point) = place_on_cage(posed_cage, point);
  };
  follow_nearest(placement.on_cage);
  if (placement.policy == OutsidePoints::kNearest) follow_nearest(placement.outside);
  if (placement.policy == OutsidePoints::kNearest || placement.outside.empty()) return moved;
  const auto outside = deform(weights(outside_of(placement)), pose.control_points, parts_->threads);
  for (std::size_t k = 0; k < placement.outside.size(); ++k) {
    moved.col(placement.outside[k].point) = outside.col(static_cast<Eigen::Index>(k));
  }
  return moved;
}

template class Evaluator<2>;
template class Evaluator<3>;

}  // namespace flbc
