// SPDX-License-Identifier: BSD-3-Clause
#include "caging/collapse_check.h"

#include <algorithm>

#include "caging/surface_tools.h"

namespace flbc {

namespace {

// The smallest altitude relative to the longest edge; 1 in 2D.
template <int Dim>
double shape_of(const Simplex<Dim>& facet) {
  if constexpr (Dim == 2) return 1;
  double longest = 0;
  for (int k = 0; k < Dim; ++k) {
    longest =
        std::max(longest, (facet.corners.col(k) - facet.corners.col((k + 1) % Dim)).squaredNorm());
  }
  return longest > 0 ? facet_normal<Dim>(facet.corners).norm() / longest : 0;
}

}  // namespace

template <int Dim>
Replacement<Dim> replacement_of(const Collapse<Dim>& plan) {
  Replacement<Dim> change{plan.ring, plan.corners, plan.ring,
                          plan.kept, plan.removed, plan.is_in_plane};
  change.old_facets.insert(change.old_facets.end(), plan.dying.begin(), plan.dying.end());
  return change;
}

template <int Dim>
Replacement<Dim> replacement_of(const EditableSurface<Dim>& surface, Index vertex) {
  const auto& facets = surface.facets_at(vertex);
  Replacement<Dim> change{facets, {}, facets, vertex, -1, surface.is_in_plane(vertex)};
  for (const Index f : facets) change.new_facets.push_back(surface.facets()[f]);
  return change;
}

template <int Dim>
CollapseCheck<Dim>::CollapseCheck(const EditableSurface<Dim>& surface,
                                  const Enclosure<Dim>& enclosure, double clearance,
                                  const CageLimits& limits)
    : surface_(surface),
      enclosure_(enclosure),
      clearance_(clearance),
      limits_(limits),
      moved_(surface.points()),
      representatives_(enclosure.representatives()) {
  const auto& plane = surface.plane();
  if (!plane.is_there()) return;
  for (Index part = 0; part < representatives_.cols(); ++part) {
    const Vector<Dim> p = representatives_.col(part);
    if (p(plane.axis) < plane.position) representatives_.col(part) = plane.mirrored(p);
  }
}

template <int Dim>
bool CollapseCheck<Dim>::keeps_limits(const Replacement<Dim>& change,
                                      const Vector<Dim>& position) const {
  // A vertex in the plane has as many facets again on the other side.
  const std::size_t valence = (change.is_in_plane ? 2 : 1) * change.new_facets.size();
  if (Dim == 3 && valence > static_cast<std::size_t>(limits_.valence)) return false;
  return enclosure_.is_within(position, limits_.reach);
}

template <int Dim>
bool CollapseCheck<Dim>::keeps_shape(const Replacement<Dim>& change,
                                     const Vector<Dim>& position) const {
  constexpr double kLeastShape = 0.12, kLeastCosine = 0.1;
  for (std::size_t k = 0; k < change.new_facets.size(); ++k) {
    const auto facet = surface_.facet_with(change.new_facets[k], change.vertex, position);
    const auto before = surface_.facet(change.predecessors[k]);
    const double least = std::min(kLeastShape, 0.5 * shape_of(before));
    if (!(shape_of(facet) > least)) return false;
    const Vector<Dim> normal = facet_normal<Dim>(facet.corners);
    const Vector<Dim> old_normal = facet_normal<Dim>(before.corners);
    if (!(normal.dot(old_normal) > kLeastCosine * normal.norm() * old_normal.norm())) return false;
  }
  return true;
}

// Half a surface touches its mirror image only in the plane.
template <int Dim>
bool CollapseCheck<Dim>::keeps_half(const Replacement<Dim>& change,
                                    const Vector<Dim>& position) const {
  const auto& plane = surface_.plane();
  if (!plane.is_there()) return true;
  if (change.is_in_plane) return plane.contains(position);
  return position(plane.axis) > plane.position + clearance_;
}

template <int Dim>
bool CollapseCheck<Dim>::meets_surface(const Replacement<Dim>& change,
                                       const Vector<Dim>& position) const {
  const auto& facets = change.new_facets;
  const auto& points = moved_;
  const auto place = [&](const FacetCorners<Dim>& corners) {
    for (const Index v : corners) moved_.col(v) = surface_.points().col(v);
    moved_.col(change.vertex) = position;
  };
  Eigen::AlignedBox<double, Dim> all(position);
  for (const auto& corners : facets) {
    place(corners);
    for (int k = 0; k < Dim; ++k) all.extend(points.col(corners(k)));
  }
  for (std::size_t k = 0; k < facets.size(); ++k) {
    for (std::size_t l = 0; l < k; ++l) {
      if (intersect_improperly<Dim>(points, facets[k], facets[l])) return true;
    }
  }
  return surface_.any_near(all, [&](Index other) {
    const auto& old = change.old_facets;
    if (std::find(old.begin(), old.end(), other) != old.end()) return false;
    place(surface_.facets()[other]);
    return std::any_of(facets.begin(), facets.end(), [&](const auto& corners) {
      Eigen::AlignedBox<double, Dim> box;
      for (int k = 0; k < Dim; ++k) box.extend(points.col(corners(k)));
      return box.intersects(surface_.box(other)) &&
             intersect_improperly<Dim>(points, corners, surface_.facets()[other]);
    });
  });
}

// The facets, and the facets moved inward by the clearance.
template <int Dim>
bool CollapseCheck<Dim>::meets_model(const Replacement<Dim>& change,
                                     const Vector<Dim>& position) const {
  for (const auto& corners : change.new_facets) {
    const auto facet = surface_.facet_with(corners, change.vertex, position);
    if (enclosure_.meets(facet)) return true;
    auto inset = facet;
    inset.corners.colwise() -= clearance_ * facet_normal<Dim>(facet.corners).normalized();
    if (enclosure_.meets(inset)) return true;
  }
  return false;
}

// Old and new facets together enclose the region that changes sides.
template <int Dim>
bool CollapseCheck<Dim>::loses_parts(const Replacement<Dim>& change,
                                     const Vector<Dim>& position) const {
  std::vector<Simplex<Dim>> facets;
  Eigen::AlignedBox<double, Dim> box;
  for (const Index f : change.old_facets) facets.push_back(surface_.facet(f));
  for (const auto& corners : change.new_facets) {
    facets.push_back(surface_.facet_with(corners, change.vertex, position));
  }
  for (const auto& facet : facets) {
    for (int k = 0; k < Dim; ++k) box.extend(Vector<Dim>(facet.corners.col(k)));
  }
  for (Index part = 0; part < representatives_.cols(); ++part) {
    const Vector<Dim> p = representatives_.col(part);
    if (box.contains(p) && has_odd_crossings(p, facets, surface_.plane().axis)) return true;
  }
  return false;
}

template <int Dim>
bool CollapseCheck<Dim>::allows(const Replacement<Dim>& change, const Vector<Dim>& position) const {
  return position.allFinite() && keeps_half(change, position) && keeps_shape(change, position) &&
         keeps_limits(change, position) && !meets_model(change, position) &&
         !meets_surface(change, position) && !loses_parts(change, position);
}

#define FLBC_INSTANTIATE(Dim)                                                   \
  template Replacement<Dim> replacement_of(const Collapse<Dim>&);               \
  template Replacement<Dim> replacement_of(const EditableSurface<Dim>&, Index); \
  template class CollapseCheck<Dim>;
FLBC_INSTANTIATE(2)
FLBC_INSTANTIATE(3)
#undef FLBC_INSTANTIATE

}  // namespace flbc
