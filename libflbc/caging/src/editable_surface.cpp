// SPDX-License-Identifier: BSD-3-Clause
#include "caging/editable_surface.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <set>
#include <utility>

#include "caging/surface_tools.h"

namespace flbc {

namespace {

template <int Dim>
bool has(const FacetCorners<Dim>& corners, Index vertex) {
  return (corners.array() == vertex).any();
}

// Whether a facet would be duplicated.
template <int Dim>
bool has_repeated(const std::vector<FacetCorners<Dim>>& facets) {
  std::set<std::array<Index, Dim>> seen;
  for (const auto& corners : facets) {
    std::array<Index, Dim> sorted;
    std::copy(corners.data(), corners.data() + Dim, sorted.begin());
    std::sort(sorted.begin(), sorted.end());
    if (!seen.insert(sorted).second) return true;
  }
  return false;
}

}  // namespace

template <int Dim>
EditableSurface<Dim>::EditableSurface(const Cage<Dim>& surface, const MirrorPlane& plane)
    : points_(surface.points), facets_at_(static_cast<std::size_t>(surface.size())), plane_(plane) {
  for (Index f = 0; f < surface.facets.cols(); ++f) {
    facets_.push_back(surface.facets.col(f));
    for (int k = 0; k < Dim; ++k) facets_at_[surface.facets(k, f)].push_back(f);
  }
  boxes_.resize(facets_.size());
  for (Index v = 0; v < surface.size(); ++v) {
    update_boxes(v);
    num_control_points_ += plane_.is_there() && !is_in_plane(v) ? 2 : 1;
  }
  update_tree();
}

template <int Dim>
void EditableSurface<Dim>::update_tree() {
  std::vector<Box> boxes;
  in_tree_.clear();
  changed_.clear();
  for (Index f = 0; f < static_cast<Index>(facets_.size()); ++f) {
    if (boxes_[f].isEmpty()) continue;
    in_tree_.push_back(f);
    boxes.push_back(boxes_[f]);
  }
  tree_ = BoxTree<Dim>(boxes);
}

template <int Dim>
void EditableSurface<Dim>::update_boxes(Index vertex) {
  for (const Index f : facets_at_[vertex]) {
    const auto corners = facet(f).corners;
    boxes_[f] = Box(corners.rowwise().minCoeff(), corners.rowwise().maxCoeff());
  }
}

template <int Dim>
std::vector<Index> EditableSurface<Dim>::neighbours(Index vertex) const {
  std::vector<Index> found;
  for (const Index f : facets_at_[vertex]) {
    for (int k = 0; k < Dim; ++k) {
      if (facets_[f](k) != vertex) found.push_back(facets_[f](k));
    }
  }
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

// The border may contain only edges of one facet, and no facet may lie in the plane.
template <int Dim>
bool EditableSurface<Dim>::keeps_border(const Collapse<Dim>& plan) const {
  if (!plan.is_in_plane) return true;
  std::vector<Index> ends;
  for (const auto& corners : plan.corners) {
    int in_plane = 0;
    for (int k = 0; k < Dim; ++k) {
      if (corners(k) == plan.kept || !is_in_plane(corners(k))) continue;
      ++in_plane;
      ends.push_back(corners(k));
    }
    if (in_plane == Dim - 1) return false;
  }
  std::sort(ends.begin(), ends.end());
  return std::adjacent_find(ends.begin(), ends.end()) == ends.end();
}

template <int Dim>
std::optional<Collapse<Dim>> EditableSurface<Dim>::plan_collapse(Index a, Index b) const {
  Collapse<Dim> plan{a, b, is_in_plane(a) || is_in_plane(b)};
  for (const Index f : facets_at_[a])
    (has<Dim>(facets_[f], b) ? plan.dying : plan.ring).push_back(f);
  for (const Index f : facets_at_[b]) {
    if (!has<Dim>(facets_[f], a)) plan.ring.push_back(f);
  }
  if (is_in_plane(a) && is_in_plane(b) && (Dim == 2 || plan.dying.size() != 1)) return {};
  // The link condition: the ends share no neighbors except those in the facets of the edge.
  const auto near_a = neighbours(a), near_b = neighbours(b);
  std::vector<Index> common;
  std::set_intersection(near_a.begin(), near_a.end(), near_b.begin(), near_b.end(),
                        std::back_inserter(common));
  if (common.size() != (Dim == 2 ? 0 : plan.dying.size())) return {};
  std::sort(plan.ring.begin(), plan.ring.end());
  for (const Index f : plan.ring) {
    FacetCorners<Dim> corners = facets_[f];
    for (int k = 0; k < Dim; ++k) {
      if (corners(k) == b) corners(k) = a;
    }
    plan.corners.push_back(corners);
  }
  if (has_repeated<Dim>(plan.corners) || !keeps_border(plan)) return {};
  return plan;
}

template <int Dim>
void EditableSurface<Dim>::collapse(const Collapse<Dim>& plan, const Vector<Dim>& position) {
  const auto [a, b] = std::pair(plan.kept, plan.removed);
  const auto weight = [&](bool in_plane) { return plane_.is_there() && !in_plane ? 2 : 1; };
  num_control_points_ += weight(plan.is_in_plane) - weight(is_in_plane(a)) - weight(is_in_plane(b));
  for (const Index f : plan.dying) {
    boxes_[f].setEmpty();
    for (int k = 0; k < Dim; ++k) {
      auto& facets = facets_at_[facets_[f](k)];
      facets.erase(std::find(facets.begin(), facets.end(), f));
    }
  }
  for (std::size_t k = 0; k < plan.ring.size(); ++k) facets_[plan.ring[k]] = plan.corners[k];
  facets_at_[b].clear();
  facets_at_[a] = plan.ring;
  move(a, position);
}

template <int Dim>
void EditableSurface<Dim>::move(Index vertex, const Vector<Dim>& position) {
  constexpr std::size_t kFewChanges = 100, kPart = 16;
  points_.col(vertex) = position;
  update_boxes(vertex);
  const auto& facets = facets_at_[vertex];
  changed_.insert(changed_.end(), facets.begin(), facets.end());
  if (changed_.size() > kFewChanges + in_tree_.size() / kPart) update_tree();
}

template <int Dim>
Simplex<Dim> EditableSurface<Dim>::facet_with(const FacetCorners<Dim>& corners, Index vertex,
                                              const Vector<Dim>& position) const {
  Simplex<Dim> simplex;
  for (int k = 0; k < Dim; ++k) {
    simplex.corners.col(k) = corners(k) == vertex ? position : Vector<Dim>(points_.col(corners(k)));
  }
  return simplex;
}

template <int Dim>
Simplex<Dim> EditableSurface<Dim>::facet(Index number) const {
  Simplex<Dim> simplex;
  for (int k = 0; k < Dim; ++k) simplex.corners.col(k) = points_.col(facets_[number](k));
  return simplex;
}

template <int Dim>
Cage<Dim> EditableSurface<Dim>::surface() const {
  std::vector<FacetCorners<Dim>> alive;
  for (std::size_t f = 0; f < facets_.size(); ++f) {
    if (!boxes_[f].isEmpty()) alive.push_back(facets_[f]);
  }
  return compact<Dim>(points_, alive);
}

template class EditableSurface<2>;
template class EditableSurface<3>;

}  // namespace flbc
