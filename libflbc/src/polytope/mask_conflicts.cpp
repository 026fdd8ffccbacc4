// SPDX-License-Identifier: BSD-3-Clause
#include "polytope/mask_conflicts.h"

#include <algorithm>
#include <limits>
#include <string>

#include "base/instantiate.h"
#include "base/messages.h"
#include "base/parallel.h"
#include "flbc/masks.h"
#include "polytope/nearest_point_in_hull.h"
#include "polytope/scaling.h"
#include "polytope/small_lu.h"

namespace flbc {
namespace {

template <int Dim>
class Feasibility {
 public:
  Feasibility(const PointList<Dim>& control_points, const PointList<Dim>& points, double tolerance)
      : control_points_(control_points),
        points_(points),
        size_(scale_of<Dim>(control_points)),
        tolerance_(tolerance * size_) {}

  bool holds(double distance) const { return distance <= tolerance_; }

  // Of a point from the convex hull of some control points.
  double distance(Index point, const std::vector<Index>& allowed) const {
    if (allowed.empty()) return std::numeric_limits<double>::infinity();
    return nearest(point, allowed).distance;
  }

  HullPoint<Dim> nearest(Index point, const std::vector<Index>& allowed) const {
    return nearest_point_in_hull<Dim>(control_points_(Eigen::all, allowed), points_.col(point));
  }

  // Whether the control points of the nearest point to another point reproduce this one too.
  bool holds(Index point, const std::vector<Index>& allowed, const HullPoint<Dim>& other) const {
    if (other.size <= Dim) return false;
    typename SmallLu<Dim + 1>::Square corners;
    typename SmallLu<Dim + 1>::Column place;
    place << points_.col(point), size_;
    for (int k = 0; k <= Dim; ++k) {
      corners.col(k) << control_points_.col(allowed[other.support[k]]), size_;
    }
    SmallLu<Dim + 1> factors;
    factors.compute(corners);
    const auto weights = factors.solve(place);
    return weights.minCoeff() >= 0 && (corners * weights - place).norm() <= tolerance_;
  }

  // Adds the control point to the allowed ones that brings their hull nearest to the point. It lies
  // on the far side of the plane that separates both.
  Index free_one(Index point, std::vector<Index>& allowed) const {
    const Vector<Dim> x = points_.col(point);
    Vector<Dim> outward = Vector<Dim>::Zero();
    if (!allowed.empty()) outward = x - nearest(point, allowed).point;
    Index best = -1;
    double least = std::numeric_limits<double>::infinity();
    for (Index i = 0; i < control_points_.cols(); ++i) {
      const Vector<Dim> offset = control_points_.col(i) - x;
      if (std::find(allowed.begin(), allowed.end(), i) != allowed.end()) continue;
      if (!allowed.empty() && outward.dot(offset) < 0) continue;
      allowed.push_back(i);
      const double remaining = nearest(point, allowed).distance;
      allowed.pop_back();
      if (best >= 0 && remaining >= least) continue;
      best = i;
      least = remaining;
    }
    if (best >= 0) allowed.push_back(best);
    return best;
  }

 private:
  const PointList<Dim>& control_points_;
  const PointList<Dim>& points_;
  double size_, tolerance_;
};

// Control points that are allowed everywhere then, ascending.
template <int Dim>
std::vector<Index> find_cure(const Feasibility<Dim>& feasibility, const PointMasks& masks,
                             const std::vector<Index>& conflicts,
                             const std::vector<Index>& images) {
  std::vector<Index> freed;
  for (const Index point : conflicts) {
    auto allowed = masks.allowed(point);
    for (const Index i : freed) {
      if (masks.forbids(point, i)) allowed.push_back(i);
    }
    while (!feasibility.holds(feasibility.distance(point, allowed))) {
      const Index i = feasibility.free_one(point, allowed);
      if (i < 0) break;  // the point is outside the hull of all
      freed.push_back(i);
      if (images.empty() || images[i] == i) continue;
      freed.push_back(images[i]);
      allowed.push_back(images[i]);
    }
  }
  std::sort(freed.begin(), freed.end());
  freed.erase(std::unique(freed.begin(), freed.end()), freed.end());
  return freed;
}

std::string list(const std::vector<Index>& numbers) {
  std::string text;
  for (const Index number : numbers) text += (text.empty() ? "" : ", ") + std::to_string(number);
  return text;
}

}  // namespace

template <int Dim>
std::vector<Index> mask_conflicts(const PointList<Dim>& control_points,
                                  const PointList<Dim>& points, const PointMasks& masks,
                                  double tolerance) {
  const Feasibility<Dim> feasibility(control_points, points, tolerance);
  const auto& masked = masks.points();
  std::vector<char> obeys(masked.size());
  struct Last {
    std::vector<Index> allowed;
    HullPoint<Dim> nearest;
  };
  constexpr Index kChunk = 64;
  const auto make_last = [] { return Last{}; };
  parallel_for_chunks(static_cast<Index>(masked.size()), kChunk, make_last,
                      [&](Index k, Last& last) {
                        const Index point = masked[k];
                        const bool is_same = k % kChunk != 0 && masks.same(masked[k - 1], point);
                        if (!is_same) last.allowed = masks.allowed(point);
                        if (!is_same) last.nearest.size = 0;
                        obeys[k] = feasibility.holds(point, last.allowed, last.nearest);
                        if (obeys[k] || last.allowed.empty()) return;
                        last.nearest = feasibility.nearest(point, last.allowed);
                        obeys[k] = feasibility.holds(last.nearest.distance);
                      });
  std::vector<Index> conflicts;
  for (std::size_t k = 0; k < masked.size(); ++k) {
    if (!obeys[k]) conflicts.push_back(masked[k]);
  }
  return conflicts;
}

template <int Dim>
void refuse_mask_conflicts(const PointList<Dim>& control_points, const PointList<Dim>& points,
                           const PointMasks& masks, const std::vector<Index>& images,
                           double tolerance) {
  const auto conflicts = mask_conflicts(control_points, points, masks, tolerance);
  if (conflicts.empty()) return;
  const Feasibility<Dim> feasibility(control_points, points, tolerance);
  const auto allowed = masks.allowed(conflicts.front());
  const auto cure = find_cure(feasibility, masks, conflicts, images);
  throw MaskConflict(
      std::to_string(conflicts.size()) + " of " + std::to_string(masks.points().size()) +
          " masked vertices cannot follow the control points that may move them; the first is "
          "vertex " +
          std::to_string(conflicts.front()) + " at " + format_point(points.col(conflicts.front())) +
          (allowed.empty()
               ? ", for which all are masked, although its weights must sum to 1"
               : ", " + format_number(feasibility.distance(conflicts.front(), allowed)) +
                     " outside their convex hull") +
          "; remove control point" + (cure.size() == 1 ? " " : "s ") + list(cure) +
          " from the masks, or make the regions smaller",
      conflicts, cure);
}

FLBC_INSTANTIATE_FUNCTION(mask_conflicts)
FLBC_INSTANTIATE_FUNCTION(refuse_mask_conflicts)

}  // namespace flbc
