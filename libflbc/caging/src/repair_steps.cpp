// SPDX-License-Identifier: BSD-3-Clause
#include "caging/repair_steps.h"

#include <numeric>
#include <set>
#include <string>
#include <utility>

#include "base/instantiate.h"
#include "base/messages.h"
#include "base/union_find.h"
#include "cage/close_points.h"
#include "caging/enclosure.h"
#include "caging/ridges.h"
#include "flbc/bounding_box.h"

namespace flbc {

namespace {

// Removes the facets that are marked.
template <int Dim>
void drop(CageDraft<Dim>& draft, const std::vector<bool>& is_dropped) {
  std::size_t kept = 0;
  for (std::size_t f = 0; f < draft.facets.size(); ++f) {
    if (!is_dropped[f]) draft.facets[kept++] = draft.facets[f];
  }
  draft.facets.resize(kept);
}

template <int Dim>
bool has_repeated_corner(const FacetCorners<Dim>& corners) {
  for (int k = 0; k < Dim; ++k) {
    if (corners(k) == corners((k + 1) % Dim)) return true;
  }
  return false;
}

template <int Dim>
double tolerance_of(const CageDraft<Dim>& draft) {
  return draft.tolerance * bounding_box_diagonal<Dim>(draft.points);
}

template <int Dim>
bool is_between(const Vector<Dim>& p, const Vector<Dim>& a, const Vector<Dim>& b,
                double tolerance) {
  const Vector<Dim> along = (b - a).normalized();
  const double place = along.dot(p - a);
  return place > 0 && place < (b - a).norm() && (p - a - place * along).norm() <= tolerance;
}

// Finds control points on edges.
template <int Dim>
class PointsOnEdges {
 public:
  explicit PointsOnEdges(const CageDraft<Dim>& draft)
      : draft_(draft), used_(used_points(draft)), tree_(boxes(draft, used_)) {}

  // The first control point between the ends; -1: none.
  Index first_between(Index from, Index to) const {
    const Vector<Dim> a = draft_.points.col(from), b = draft_.points.col(to);
    const double tolerance = tolerance_of(draft_);
    typename BoxTree<Dim>::Box around(a.cwiseMin(b).array() - tolerance,
                                      a.cwiseMax(b).array() + tolerance);
    Index first = -1;
    tree_.any_of(around, [&](Index k) {
      const Index v = used_[k];
      if (v == from || v == to || (first >= 0 && v > first)) return false;
      if (is_between<Dim>(draft_.points.col(v), a, b, tolerance)) first = v;
      return false;
    });
    return first;
  }

 private:
  static std::vector<Index> used_points(const CageDraft<Dim>& draft) {
    std::set<Index> used;
    for (const auto& facet : draft.facets) used.insert(facet.corners.begin(), facet.corners.end());
    return {used.begin(), used.end()};
  }
  static std::vector<typename BoxTree<Dim>::Box> boxes(const CageDraft<Dim>& draft,
                                                       const std::vector<Index>& used) {
    std::vector<typename BoxTree<Dim>::Box> result;
    for (const Index v : used) result.emplace_back(Vector<Dim>(draft.points.col(v)));
    return result;
  }

  const CageDraft<Dim>& draft_;
  std::vector<Index> used_;
  BoxTree<Dim> tree_;
};

template <int Dim>
void report_split(CageDraft<Dim>& draft, Index facet, Index point) {
  draft.changes.push_back(name_of_facet<Dim>(facet) + " is split at " +
                          describe_control_point<Dim>(draft.points, point) + ", which lies on " +
                          (Dim == 2 ? "it" : "its edge"));
}

// The smallest patch that has an open border and meets two other patches elsewhere; -1: none.
template <int Dim>
Index find_flap(const CageDraft<Dim>& draft, const std::vector<Index>& patch_of_facet,
                const RidgeMap<Dim>& ridges, bool only_double) {
  const std::size_t count = patch_of_facet.size();
  std::vector<bool> is_open(count, false), is_crowded(count, false), stays(count, false);
  std::vector<Index> size(count, 0);
  for (std::size_t f = 0; f < count; ++f) {
    ++size[patch_of_facet[f]];
    if (only_double && !draft.facets[f].is_double) stays[patch_of_facet[f]] = true;
  }
  for (const auto& [ridge, facets] : ridges) {
    for (const Index f : facets) {
      if (facets.size() == 1) is_open[patch_of_facet[f]] = true;
      if (facets.size() > 2) is_crowded[patch_of_facet[f]] = true;
    }
  }
  Index flap = -1;
  for (Index patch = 0; patch < static_cast<Index>(count); ++patch) {
    if (!is_open[patch] || !is_crowded[patch] || stays[patch]) continue;
    if (flap < 0 || size[patch] < size[flap]) flap = patch;
  }
  return flap;
}

}  // namespace

template <int Dim>
CageDraft<Dim> draft_of(const Cage<Dim>& cage) {
  CageDraft<Dim> draft{cage.points, {}, std::vector<Index>(static_cast<std::size_t>(cage.size()))};
  for (Index f = 0; f < cage.facets.cols(); ++f) draft.facets.push_back({cage.facets.col(f), f});
  std::iota(draft.merged_into.begin(), draft.merged_into.end(), 0);
  return draft;
}

template <int Dim>
void merge_close_points(CageDraft<Dim>& draft) {
  UnionFind heaps(static_cast<Index>(draft.points.cols()));
  for (const auto& [i, j] : find_close_pairs<Dim>(draft.points, tolerance_of(draft),
                                                  static_cast<std::size_t>(draft.points.cols()))) {
    heaps.unite(i, j);
  }
  for (Index v = 0; v < static_cast<Index>(draft.merged_into.size()); ++v) {
    const Index first = heaps.find(v);
    if (draft.merged_into[v] == first) continue;
    draft.merged_into[v] = first;
    draft.changes.push_back(describe_control_point<Dim>(draft.points, v) +
                            " is merged into control point " + std::to_string(first));
  }
  for (auto& facet : draft.facets) {
    for (int k = 0; k < Dim; ++k) facet.corners(k) = heaps.find(facet.corners(k));
  }
}

void split_at_points(CageDraft<2>& draft) {
  const PointsOnEdges<2> points(draft);
  for (std::size_t f = 0; f < draft.facets.size(); ++f) {
    while (true) {
      auto& facet = draft.facets[f];
      const Index between = points.first_between(facet.corners(0), facet.corners(1));
      if (between < 0) break;
      report_split(draft, facet.number, between);
      auto rest = facet;
      rest.corners(0) = between;
      facet.corners(1) = between;
      draft.facets.push_back(rest);
    }
  }
}

// All triangles at an edge are split alike, so that a closed surface stays closed. Those whose
// third corner is the control point on the edge have no area, and are removed.
void split_at_points(CageDraft<3>& draft) {
  const PointsOnEdges<3> points(draft);
  auto ridges = collect_ridges(draft);
  std::vector<Ridge<3>> to_do;
  for (const auto& [ridge, facets] : ridges) to_do.push_back(ridge);
  std::vector<bool> is_dropped(draft.facets.size(), false);
  const auto enter = [&](Index f) {
    for (int k = 0; k < 3; ++k) {
      const auto ridge = ridge_of<3>(draft.facets[f].corners, k);
      ridges[ridge].push_back(f);
      to_do.push_back(ridge);
    }
  };
  const auto leave = [&](Index f) {
    for (int k = 0; k < 3; ++k) {
      auto& facets = ridges[ridge_of<3>(draft.facets[f].corners, k)];
      facets.erase(std::find(facets.begin(), facets.end(), f));
    }
  };
  // Heaps of points that are closer than the tolerance to many edges could be split forever.
  const std::size_t most = 4 * draft.facets.size() + 100;
  while (!to_do.empty() && draft.facets.size() < most) {
    const auto [from, to] = to_do.back();
    to_do.pop_back();
    const auto facets = ridges[{from, to}];  // a copy
    if (from == to || facets.empty()) continue;
    const Index between = points.first_between(from, to);
    if (between < 0) continue;
    for (const Index f : facets) {
      auto& facet = draft.facets[f];
      if (has_repeated_corner<3>(facet.corners)) continue;
      leave(f);
      if ((facet.corners.array() == between).any()) {
        is_dropped[f] = true;
        draft.changes.push_back(name_of_facet<3>(facet.number) + " has no area and is removed");
        continue;
      }
      report_split(draft, facet.number, between);
      auto rest = facet;
      for (Index& v : rest.corners) v = v == from ? between : v;
      for (Index& v : facet.corners) v = v == to ? between : v;
      draft.facets.push_back(rest);
      is_dropped.push_back(false);
      enter(f);
      enter(static_cast<Index>(draft.facets.size()) - 1);
    }
  }
  drop(draft, is_dropped);
}

template <int Dim>
void drop_degenerate_facets(CageDraft<Dim>& draft) {
  std::vector<bool> is_dropped(draft.facets.size(), false);
  for (std::size_t f = 0; f < draft.facets.size(); ++f) {
    const auto& facet = draft.facets[f];
    is_dropped[f] = has_repeated_corner<Dim>(facet.corners);
    if (!is_dropped[f]) continue;
    draft.changes.push_back(name_of_facet<Dim>(facet.number) +
                            " has the same corner twice and is removed");
  }
  drop(draft, is_dropped);
}

template <int Dim>
void drop_repeated_facets(CageDraft<Dim>& draft) {
  std::map<std::pair<Index, std::array<Index, Dim>>, Index> first_with;
  std::vector<bool> is_dropped(draft.facets.size(), false);
  for (std::size_t f = 0; f < draft.facets.size(); ++f) {
    std::array<Index, Dim> corners;
    for (int k = 0; k < Dim; ++k) corners[k] = draft.facets[f].corners(k);
    std::sort(corners.begin(), corners.end());
    const auto [entry, is_new] =
        first_with.emplace(std::pair(draft.facets[f].part, corners), static_cast<Index>(f));
    if (is_new) continue;
    is_dropped[f] = draft.facets[entry->second].is_double = true;
    draft.changes.push_back(name_of_facet<Dim>(draft.facets[f].number) + " is the same as " +
                            name_of_facet<Dim>(draft.facets[entry->second].number) +
                            " and is removed");
  }
  drop(draft, is_dropped);
}

template <int Dim>
void drop_flaps(CageDraft<Dim>& draft, bool only_double) {
  for (;;) {
    const auto ridges = collect_ridges(draft);
    const auto patch_of_facet = collect_patches(draft, ridges);
    const Index flap = find_flap(draft, patch_of_facet, ridges, only_double);
    if (flap < 0) return;
    std::vector<bool> is_dropped(draft.facets.size(), false);
    for (std::size_t f = 0; f < draft.facets.size(); ++f) {
      is_dropped[f] = patch_of_facet[f] == flap;
      if (is_dropped[f]) {
        draft.changes.push_back(name_of_facet<Dim>(draft.facets[f].number) +
                                " belongs to a flap that hangs on other facets and is removed");
      }
    }
    drop(draft, is_dropped);
  }
}

FLBC_INSTANTIATE_FUNCTION(draft_of)
FLBC_INSTANTIATE_FUNCTION(merge_close_points)
FLBC_INSTANTIATE_FUNCTION(drop_degenerate_facets)
FLBC_INSTANTIATE_FUNCTION(drop_repeated_facets)
FLBC_INSTANTIATE_FUNCTION(drop_flaps)

}  // namespace flbc
