// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/place_masks.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <optional>

#include "base/instantiate.h"
#include "base/messages.h"
#include "cage/facet_locator.h"
#include "flbc/bounding_box.h"
#include "flbc/errors.h"
#include "flbc/masks.h"
#include "flbc/mirror.h"
#include "flbc/non_negative.h"
#include "linear/dense.h"
#include "polytope/mask_conflicts.h"

namespace flbc {
namespace {

// Masked control points by point.
using Forbidden = std::map<Index, std::vector<Index>>;

std::vector<Mask> list(const Forbidden& forbidden) {
  std::map<std::vector<Index>, std::vector<Index>> points_of;
  for (const auto& [point, control_points] : forbidden) {
    if (!control_points.empty()) points_of[control_points].push_back(point);
  }
  std::vector<Mask> masks;
  for (const auto& [control_points, points] : points_of) masks.push_back({control_points, points});
  return masks;
}

// Frees the corners of the facet on which a masked point lies.
// \param control_points  masked there \return whether some were freed
template <int Dim>
bool end_at(const Cage<Dim>& cage, Index facet, const Vector<Dim>& coordinates,
            std::vector<Index>& control_points) {
  const auto before = control_points.size();
  for (int k = 0; k < Dim; ++k) {
    if (coordinates[k] <= kBoundaryTolerance) continue;
    control_points.erase(
        std::remove(control_points.begin(), control_points.end(), cage.facets(k, facet)),
        control_points.end());
  }
  return control_points.size() < before;
}

// The same for all masked points that are nearly on the cage. \return their number
template <int Dim>
Index end_near_cage(const Cage<Dim>& cage, const PointList<Dim>& points, Forbidden& forbidden) {
  const FacetLocator<Dim> locator(cage, kBoundaryTolerance * bounding_box_diagonal(cage.points));
  Index count = 0;
  for (auto& [point, control_points] : forbidden) {
    const auto place = locator.locate(points.col(point));
    if (place.facet < 0) continue;
    count += end_at<Dim>(cage, place.facet, place.coordinates, control_points) ? 1 : 0;
  }
  return count;
}

Forbidden forbidden_at(const PointMasks& masks) {
  Forbidden forbidden;
  for (const Index point : masks.points()) forbidden[point] = masks.forbidden(point);
  return forbidden;
}

// Removes points from the first, and returns their masks.
template <int Dim>
Forbidden take(const std::vector<NearestOnCage<Dim>>& points, Forbidden& from) {
  Forbidden taken;
  for (const auto& nearest : points) {
    const auto found = from.find(nearest.point);
    if (found == from.end()) continue;
    taken.insert(*found);
    from.erase(found);
  }
  return taken;
}

// The masks of the corners of cells with masked points, except where vertices cannot obey.
template <int Dim>
std::vector<Mask> masks_of_cells(const Cage<Dim>& cage, const DomainMesh<Dim>& mesh,
                                 const Placement<Dim>& placement, const Forbidden& forbidden) {
  Forbidden of_vertices;
  for (const auto& [point, control_points] : forbidden) {
    const Index cell = placement.places[point].cell;
    if (cell < 0) continue;
    for (const Index v : mesh.cells.col(cell)) {
      auto& list = of_vertices[v];
      if (std::includes(list.begin(), list.end(), control_points.begin(), control_points.end())) {
        continue;
      }
      std::vector<Index> both;
      std::set_union(list.begin(), list.end(), control_points.begin(), control_points.end(),
                     std::back_inserter(both));
      list = std::move(both);
    }
  }
  const PointMasks masks(list(of_vertices), cage.size(), mesh.num_vertices());
  const auto conflicts = mask_conflicts(cage.points, mesh.points, masks);
  return masks.list(
      [&](Index v) { return !std::binary_search(conflicts.begin(), conflicts.end(), v); });
}

// The weights of some control points nearest to given ones, of any sign, that reproduce a point.
// \return empty if there are none
template <int Dim>
std::optional<Eigen::VectorXd> affine_weights(const PointList<Dim>& control_points,
                                              const Vector<Dim>& point,
                                              const std::vector<Index>& some,
                                              Eigen::VectorXd weights) {
  constexpr double kExact = 1e-13;
  if (some.empty()) return {};
  const double size = bounding_box_diagonal(control_points);
  Eigen::MatrixXd sums(Dim + 1, some.size());
  sums.row(0).setOnes();
  sums.bottomRows(Dim) = (control_points(Eigen::all, some).colwise() - point) / size;
  const Vector<Dim + 1> wanted = Vector<Dim + 1>::Unit(0);
  Eigen::VectorXd few = weights(some);
  for (int pass = 0; pass < 2; ++pass) few += dense::least_squares(sums, wanted - sums * few);
  if (!((sums * few - wanted).norm() <= kExact)) return {};
  weights(some) = few;
  return weights;
}

// The nearest weights without the masked ones; on their support if that suffices.
template <int Dim>
Eigen::VectorXd without_masked(const PointList<Dim>& control_points, const Vector<Dim>& point,
                               const PointMasks& masks, Index p, Eigen::VectorXd weights) {
  weights(masks.forbidden(p)).setZero();
  std::vector<Index> support;
  for (const Index i : masks.allowed(p)) {
    if (weights[i] != 0) support.push_back(i);
  }
  if (const auto found = affine_weights<Dim>(control_points, point, support, weights)) {
    return *found;
  }
  return affine_weights<Dim>(control_points, point, masks.allowed(p), weights).value();
}

// \param masks  of points with OutsidePoints::kExtend
template <int Dim>
void require_affine_weights(const Cage<Dim>& cage, const PointList<Dim>& points,
                            const PointMasks& masks) {
  for (const Index p : masks.points()) {
    if (affine_weights<Dim>(cage.points, points.col(p), masks.allowed(p),
                            Eigen::VectorXd::Zero(cage.size()))) {
      continue;
    }
    throw InputError(
        "vertex " + std::to_string(p) + " at " + format_point(points.col(p)) +
        ", outside the cage, cannot follow the control points that may move it, " +
        (masks.allowed(p).empty() ? "of which there are none" : "which are in one plane or line") +
        "; leave it out of the region, or let it follow the nearest point of the cage "
        "(outside nearest)");
  }
}

}  // namespace

std::vector<Mask> PlacedMasks::of_all() const {
  auto all = of_points;
  all.insert(all.end(), of_outside.begin(), of_outside.end());
  return all;
}

std::string PlacedMasks::note() const {
  if (on_facets == 0) return "";
  return std::to_string(on_facets) + " of " + std::to_string(masked) +
         " masked vertices are on facets of masked control points, which still move them";
}

template <int Dim>
std::vector<Mask> end_at_facets(const Cage<Dim>& cage, const PointList<Dim>& points,
                                const std::vector<Mask>& masks, Index* on_facets) {
  auto forbidden = forbidden_at(PointMasks(masks, cage.size(), static_cast<Index>(points.cols())));
  const Index count = end_near_cage(cage, points, forbidden);
  if (on_facets != nullptr) *on_facets = count;
  return list(forbidden);
}

template <int Dim>
std::vector<Mask> relax_masks(const Cage<Dim>& cage, const PointList<Dim>& points,
                              std::vector<Mask> masks, std::vector<Index>& freed, int mirror_axis) {
  freed.clear();
  const auto place = [&](const PointList<Dim>& given) {
    return place_points(cage, given, OutsidePoints::kNearest);
  };
  auto placement = place(points);
  std::vector<Index> images;
  if (mirror_axis >= 0) {
    const MirroredModel<Dim> mirror(cage, mirror_axis, points);
    mirror.symmetrize(placement, [&](const PointList<Dim>& given) { return place(given).points; });
    masks = mirror.symmetrized(masks);
    images = mirror.images();
  }
  const PointMasks inside(end_at_facets(cage, placement.points, masks), cage.size(),
                          static_cast<Index>(points.cols()));
  try {
    refuse_mask_conflicts(cage.points, placement.points, inside, images, kBoundaryTolerance);
  } catch (const MaskConflict& conflict) {
    freed = conflict.control_points;
  }
  for (auto& [control_points, region] : masks) {
    const auto is_free = [&](Index i) { return std::binary_search(freed.begin(), freed.end(), i); };
    control_points.erase(std::remove_if(control_points.begin(), control_points.end(), is_free),
                         control_points.end());
  }
  return masks;
}

template <int Dim>
PlacedMasks place_masks(const Cage<Dim>& cage, const DomainMesh<Dim>& mesh,
                        const Placement<Dim>& placement, const std::vector<Mask>& masks,
                        const std::vector<Index>& images) {
  if (masks.empty()) return {};
  const auto num_points = static_cast<Index>(placement.points.cols());
  auto forbidden = forbidden_at(PointMasks(masks, cage.size(), num_points));
  PlacedMasks placed;
  placed.masked = static_cast<Index>(forbidden.size());
  const bool follows = placement.policy == OutsidePoints::kNearest;
  if (!follows) {
    auto outside = take(placement.outside, forbidden);
    if (placement.policy == OutsidePoints::kExtend) placed.of_outside = list(outside);
  }
  for (const auto* points : {&placement.on_cage, &placement.outside}) {
    for (const auto& nearest : *points) {
      const auto found = forbidden.find(nearest.point);
      if (found == forbidden.end()) continue;
      const bool ends = end_at<Dim>(cage, nearest.facet, nearest.coordinates, found->second);
      placed.on_facets += ends ? 1 : 0;
    }
  }
  auto inside = forbidden;
  take(placement.on_cage, inside);
  take(placement.outside, inside);
  placed.on_facets += end_near_cage(cage, placement.points, inside);
  for (const auto& [point, control_points] : inside) forbidden[point] = control_points;
  placed.of_points = list(forbidden);
  refuse_mask_conflicts(cage.points, placement.points,
                        PointMasks(placed.of_points, cage.size(), num_points), images,
                        kBoundaryTolerance);
  require_affine_weights(cage, placement.points,
                         PointMasks(placed.of_outside, cage.size(), num_points));
  placed.of_mesh = placement.places.empty() ? placed.of_points
                                            : masks_of_cells(cage, mesh, placement, forbidden);
  return placed;
}

template <int Dim>
SparseWeights enforce_masks(const Cage<Dim>& cage, const Placement<Dim>& placement,
                            const SparseWeights& weights, const PlacedMasks& masks) {
  const auto num_points = static_cast<Index>(placement.points.cols());
  const PointMasks inside(masks.of_points, cage.size(), num_points);
  const PointMasks outside(masks.of_outside, cage.size(), num_points);
  auto result =
      project_non_negative(cage.points, placement.points, weights, inside.points(), inside);
  if (outside.empty()) return result;
  return SparseWeights::of(cage.size(), num_points, [&](Index p) {
    if (!outside.at(p)) return result.at(p);
    return without_masked<Dim>(cage.points, placement.points.col(p), outside, p, result.at(p));
  });
}

FLBC_INSTANTIATE_FUNCTION(end_at_facets)
FLBC_INSTANTIATE_FUNCTION(relax_masks)
FLBC_INSTANTIATE_FUNCTION(place_masks)
FLBC_INSTANTIATE_FUNCTION(enforce_masks)

}  // namespace flbc
