// SPDX-License-Identifier: BSD-3-Clause
#include "binding/solid.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <queue>
#include <utility>

#include "base/first_equals.h"
#include "base/instantiate.h"
#include "base/messages.h"
#include "base/take_points.h"
#include "flbc/bounding_box.h"
#include "flbc/errors.h"
#include "flbc/non_negative.h"
#include "mesh/vertex_cells.h"
#include "polytope/affine_weights.h"

namespace flbc {
namespace {

template <int Dim>
struct Region {
  const Binding<Dim>& binding;
  std::size_t number;
  const std::vector<Index>& points = binding.solid[number];
  PointList<Dim> places = binding.points(Eigen::all, points);
  AffineWeights<Dim> affine{binding.cage.points, places};
  typename AffineWeights<Dim>::Columns columns{};

  double size() const { return bounding_box_diagonal<Dim>(places); }

  [[noreturn]] void refuse(const std::string& reason) const {
    const double part = 100 * size() / bounding_box_diagonal(binding.cage.points);
    throw InputError("solid region " + std::to_string(number) + " of " +
                     std::to_string(points.size()) + " vertices, " + format_number(part) +
                     "% of the cage size, cannot move by one affine map: " + reason +
                     ", or mark fewer vertices as solid");
  }

  // The control points that are masked nowhere in the region, or those that are.
  std::vector<Index> control_points(bool are_masked) const {
    const PointMasks masks(binding.masks, binding.cage.size(),
                           static_cast<Index>(binding.points.cols()));
    std::vector<Index> found;
    for (Index i = 0; i < binding.cage.size(); ++i) {
      const bool is_masked =
          std::any_of(points.begin(), points.end(), [&](Index p) { return masks.forbids(p, i); });
      if (is_masked == are_masked) found.push_back(i);
    }
    return found;
  }

  // Columns become the nearest feasible ones.
  void project() {
    const auto given = columns;
    if (affine.project(control_points(false), given, columns)) return;
    const auto masked = control_points(true);
    refuse(masked.empty() ? "the cage does not surround it far enough; enlarge the cage there"
                          : "masks leave too few control points around it; mask fewer than " +
                                describe_list(masked) + " there, enlarge the cage");
  }
};

// Regions with the columns that fit the weights.
template <int Dim>
std::vector<Region<Dim>> regions_of(const Binding<Dim>& binding) {
  std::vector<Region<Dim>> regions;
  for (std::size_t k = 0; k < binding.solid.size(); ++k) {
    regions.push_back({binding, k});
    auto& region = regions.back();
    region.columns = region.affine.fit(take_points(binding.weights, region.points));
  }
  return regions;
}

// The weights with those of the regions.
template <int Dim>
SparseWeights weights_of(const std::vector<Region<Dim>>& regions, const Binding<Dim>& binding) {
  std::vector<const Region<Dim>*> region_of(binding.points.cols());
  for (const auto& region : regions) {
    for (const Index p : region.points) region_of[p] = &region;
  }
  return SparseWeights::of(
      binding.cage.size(), binding.weights.num_points(), [&](Index p) -> Eigen::VectorXd {
        if (!region_of[p]) return binding.weights.at(p);
        return region_of[p]->affine.at(binding.points.col(p), region_of[p]->columns).cwiseMax(0);
      });
}

// Distances from a region along edges. Coincident points, which seams of a mesh separate, are one.
// \param around  neighbors \param first  of coincident points
template <int Dim>
std::vector<double> distances_from(const Region<Dim>& region, const VertexItems<Index>& around,
                                   const std::vector<Index>& first) {
  using Entry = std::pair<double, Index>;
  const auto& places = region.binding.points;
  std::vector<double> distances(first.size(), std::numeric_limits<double>::infinity());
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  const auto reach = [&](Index p, double distance) {
    if (distance >= distances[p]) return;
    distances[p] = distance;
    open.push({distance, p});
  };
  for (const Index p : region.points) reach(first[p], 0);
  while (!open.empty()) {
    const auto [distance, p] = open.top();
    open.pop();
    if (distance > distances[p]) continue;
    for (const Index q : around.of(p)) reach(q, distance + (places.col(q) - places.col(p)).norm());
  }
  for (std::size_t p = 0; p < first.size(); ++p) distances[p] = distances[first[p]];
  return distances;
}

}  // namespace

template <int Dim>
void require_solid(const Binding<Dim>& binding) {
  if (binding.mirror) {
    throw InputError("solid regions and an exact mirror exclude each other; leave out one of them");
  }
  const auto& outside = binding.outside;
  std::vector<bool> is_solid(binding.points.cols(), false);
  for (std::size_t k = 0; k < binding.solid.size(); ++k) {
    for (const Index p : binding.solid[k]) {
      const char* fault = p < 0 || p >= binding.points.cols() ? "does not exist"
                          : is_solid[p] ? "is in a solid region already; mark it once"
                          : std::binary_search(outside.begin(), outside.end(), p)
                              ? "is outside the cage; leave it out, or enlarge the cage"
                              : nullptr;
      if (fault) {
        throw InputError("solid region " + std::to_string(k) + ": vertex " + std::to_string(p) +
                         " " + fault);
      }
      is_solid[p] = true;
    }
    if (binding.solid[k].empty()) {
      throw InputError("solid region " + std::to_string(k) + " has no vertices");
    }
    Region<Dim> region{binding, k};
    region.columns.setZero(Dim + 1, binding.cage.size());
    region.project();
  }
}

// In the band of a region, at distance d from it along the mesh, weights are (1 - s) w + s e, with
// the original weights w, those of the region extended e, and the smooth s(t) = t^2 (3 - 2 t) of t
// = 1 - d / L. Sums and reproduction of w and e hold for their mean, and it is >= 0 where e >= 0.
// Elsewhere, project_non_negative() takes the nearest feasible weights; it is continuous and leaves
// feasible weights as they are, so weights are continuous up to the region. L is half the size of
// the region, over which the deformation differs from an affine map about as much as in the region,
// but at least three edges, below which a ramp is a step. Bands of neighboring regions end in the
// middle between them.
template <int Dim>
void make_solid(Binding<Dim>& binding) {
  constexpr double kEdges = 3;
  if (binding.solid.empty()) return;
  auto regions = regions_of(binding);
  for (auto& region : regions) region.project();
  auto solid = weights_of(regions, binding);
  const auto& points = binding.points;
  const auto first = first_equals<Dim>(points);
  const auto around = items_by_vertex<Index>(first.size(), [&](const auto& visit) {
    for (const auto& [a, b] : binding.edges.ends) {
      visit(first[a], first[b]);
      visit(first[b], first[a]);
    }
  });
  const double infinity = std::numeric_limits<double>::infinity();
  Eigen::ArrayXd nearest = Eigen::ArrayXd::Constant(points.cols(), infinity), second = nearest;
  std::vector<const Region<Dim>*> region_of(points.cols());
  std::vector<double> widths;
  for (const auto& region : regions) {
    double sum = 0, count = 1e-300;
    for (const Index p : region.points) {
      for (const Index q : around.of(first[p])) {
        sum += (points.col(p) - points.col(q)).norm();
        ++count;
      }
    }
    widths.push_back(std::max(region.size() / 2, kEdges * sum / count));
    const auto distances = distances_from(region, around, first);
    for (Index p = 0; p < points.cols(); ++p) {
      second[p] = std::min(second[p], std::max(nearest[p], distances[p]));
      if (distances[p] >= nearest[p]) continue;
      nearest[p] = distances[p];
      region_of[p] = &region;
    }
  }
  for (const auto& region : regions) {
    for (const Index p : region.points) region_of[p] = nullptr;
  }
  std::vector<Index> blended;
  const auto share = [&](Index p) {
    if (!region_of[p] || !binding.weights.has_weights(p)) return 0.0;
    const double t =
        1 - nearest[p] / std::min(widths[region_of[p]->number], (nearest[p] + second[p]) / 2);
    return t > 0 ? t * t * (3 - 2 * t) : 0;
  };
  for (Index p = 0; p < points.cols(); ++p) {
    const auto& outside = binding.outside;
    if (std::binary_search(outside.begin(), outside.end(), p)) region_of[p] = nullptr;
    if (share(p) > 0) blended.push_back(p);
  }
  const auto blend =
      SparseWeights::of(binding.cage.size(), solid.num_points(), [&](Index p) -> Eigen::VectorXd {
        const double s = share(p);
        if (s == 0) return solid.at(p);
        return (1 - s) * solid.at(p) +
               s * region_of[p]->affine.at(points.col(p), region_of[p]->columns);
      });
  binding.weights = project_non_negative<Dim>(
      binding.cage.points, points, blend, blended,
      {binding.masks, binding.cage.size(), static_cast<Index>(points.cols())});
}

template <int Dim>
SparseWeights with_few_in_solid(const Binding<Dim>& binding, Index most) {
  auto regions = regions_of(binding);
  for (auto& region : regions) {
    const auto given = region.columns;
    if (region.affine.reduce(region.control_points(false), most, given, region.columns)) continue;
    region.refuse("no " + std::to_string(most) + " control points surround it" +
                  "; allow more influences");
  }
  return weights_of(regions, binding);
}

std::string note_on_solid(const std::vector<std::vector<Index>>& solid) {
  if (solid.empty()) return "";
  std::size_t count = 0;
  for (const auto& region : solid) count += region.size();
  return std::to_string(count) + " vertices are solid (regions: " + std::to_string(solid.size()) +
         "), so a certificate does not hold for their weights and those around";
}

FLBC_INSTANTIATE_FUNCTION(require_solid)
FLBC_INSTANTIATE_FUNCTION(make_solid)
FLBC_INSTANTIATE_FUNCTION(with_few_in_solid)

}  // namespace flbc
