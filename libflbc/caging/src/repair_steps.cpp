// SPDX-License-Identifier: BSD-3-Clause
#include "caging/repair_steps.h"

#include <numeric>
#include <set>
#include <string>

#include "base/instantiate.h"
#include "base/messages.h"
#include "base/union_find.h"
#include "cage/close_points.h"
#include "caging/ridges.h"
#include "caging/surface_tools.h"
#include "flbc/bounding_box.h"

namespace flbc {

namespace {

template <int Dim>
std::string name_of(const typename CageDraft<Dim>::Facet& facet) {
  const std::string kind = Dim == 2 ? "edge" : "triangle";
  return facet.number < 0 ? "a new " + kind : kind + " " + std::to_string(facet.number);
}

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

// The middle corner of a triangle with collinear corners; -1 if they are not collinear.
int middle_corner(const CageDraft<3>& draft, const FacetCorners<3>& corners) {
  constexpr double kRelativeTolerance = 1e-10;
  Eigen::Matrix3d p;
  for (int k = 0; k < 3; ++k) p.col(k) = draft.points.col(corners(k));
  int middle = 0;
  double longest = 0;
  for (int k = 0; k < 3; ++k) {
    const double length = (p.col((k + 1) % 3) - p.col((k + 2) % 3)).norm();
    if (length > longest) middle = k;
    longest = std::max(longest, length);
  }
  const double tolerance = kRelativeTolerance * bounding_box_diagonal<3>(draft.points);
  return facet_normal<3>(p).norm() > tolerance * longest ? -1 : middle;
}

// Splits the triangle at the edge opposite to the middle corner.
void cut_neighbour(CageDraft<3>& draft, std::size_t flat, int middle) {
  const auto corners = draft.facets[flat].corners;
  const Ridge<3> edge = ridge_of<3>(corners, middle);
  for (std::size_t f = 0; f < draft.facets.size(); ++f) {
    if (f == flat) continue;
    for (int k = 0; k < 3; ++k) {
      const auto other = draft.facets[f].corners;
      if (ridge_of<3>(other, k) != edge || other(k) == corners(middle)) continue;
      draft.facets[f].corners((k + 1) % 3) = corners(middle);
      draft.facets[flat].corners = other;
      draft.facets[flat].corners((k + 2) % 3) = corners(middle);
      return;
    }
  }
}

void cut_at_flat_triangles(CageDraft<3>& draft) {
  std::vector<bool> is_dropped(draft.facets.size(), false);
  for (std::size_t f = 0; f < draft.facets.size(); ++f) {
    const auto corners = draft.facets[f].corners;
    const int middle = middle_corner(draft, corners);
    if (middle < 0) continue;
    draft.changes.push_back(
        name_of<3>(draft.facets[f]) + " has no area and is removed; its neighbor gets " +
        describe_control_point<3>(draft.points, corners(middle)) + " as a corner");
    cut_neighbour(draft, f, middle);
    is_dropped[f] = draft.facets[f].corners == corners;
  }
  drop(draft, is_dropped);
}

// Parts of the draft connected by ridges with two facets.
template <int Dim>
std::vector<Index> collect_patches(const CageDraft<Dim>& draft, const RidgeMap<Dim>& ridges) {
  UnionFind patches(static_cast<Index>(draft.facets.size()));
  for (const auto& [ridge, facets] : ridges) {
    if (facets.size() == 2) patches.unite(facets[0], facets[1]);
  }
  std::vector<Index> patch_of_facet(draft.facets.size());
  for (Index f = 0; f < static_cast<Index>(patch_of_facet.size()); ++f) {
    patch_of_facet[f] = patches.find(f);
  }
  return patch_of_facet;
}

// The smallest patch that has an open border and meets two other patches elsewhere; -1: none.
template <int Dim>
Index find_flap(const std::vector<Index>& patch_of_facet, const RidgeMap<Dim>& ridges) {
  const std::size_t count = patch_of_facet.size();
  std::vector<bool> is_open(count, false), is_crowded(count, false);
  std::vector<Index> size(count, 0);
  for (const Index patch : patch_of_facet) ++size[patch];
  for (const auto& [ridge, facets] : ridges) {
    for (const Index f : facets) {
      if (facets.size() == 1) is_open[patch_of_facet[f]] = true;
      if (facets.size() > 2) is_crowded[patch_of_facet[f]] = true;
    }
  }
  Index flap = -1;
  for (Index patch = 0; patch < static_cast<Index>(count); ++patch) {
    if (!is_open[patch] || !is_crowded[patch]) continue;
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
  constexpr double kRelativeTolerance = 1e-6;
  const double tolerance = kRelativeTolerance * bounding_box_diagonal<Dim>(draft.points);
  UnionFind heaps(static_cast<Index>(draft.points.cols()));
  for (const auto& [i, j] : find_close_pairs<Dim>(draft.points, tolerance,
                                                  static_cast<std::size_t>(draft.points.cols()))) {
    heaps.unite(i, j);
  }
  for (Index v = 0; v < draft.points.cols(); ++v) {
    const Index first = heaps.find(v);
    draft.merged_into[v] = first;
    if (first == v) continue;
    draft.changes.push_back(describe_control_point<Dim>(draft.points, v) +
                            " is merged into control point " + std::to_string(first));
  }
  for (auto& facet : draft.facets) {
    for (int k = 0; k < Dim; ++k) facet.corners(k) = draft.merged_into[facet.corners(k)];
  }
}

template <int Dim>
void drop_degenerate_facets(CageDraft<Dim>& draft) {
  std::vector<bool> is_dropped(draft.facets.size(), false);
  for (std::size_t f = 0; f < draft.facets.size(); ++f) {
    is_dropped[f] = has_repeated_corner<Dim>(draft.facets[f].corners);
    if (is_dropped[f]) {
      draft.changes.push_back(name_of<Dim>(draft.facets[f]) +
                              " has the same corner twice and is removed");
    }
  }
  drop(draft, is_dropped);
  if constexpr (Dim == 3) cut_at_flat_triangles(draft);
}

template <int Dim>
void drop_repeated_facets(CageDraft<Dim>& draft) {
  std::map<std::array<Index, Dim>, Index> first_with;
  std::vector<bool> is_dropped(draft.facets.size(), false);
  for (std::size_t f = 0; f < draft.facets.size(); ++f) {
    std::array<Index, Dim> corners;
    for (int k = 0; k < Dim; ++k) corners[k] = draft.facets[f].corners(k);
    std::sort(corners.begin(), corners.end());
    const auto [entry, is_new] = first_with.emplace(corners, static_cast<Index>(f));
    if (is_new) continue;
    is_dropped[f] = true;
    draft.changes.push_back(name_of<Dim>(draft.facets[f]) + " is the same as " +
                            name_of<Dim>(draft.facets[entry->second]) + " and is removed");
  }
  drop(draft, is_dropped);
}

template <int Dim>
void drop_flaps(CageDraft<Dim>& draft) {
  for (;;) {
    const auto ridges = collect_ridges(draft);
    const auto patch_of_facet = collect_patches(draft, ridges);
    const Index flap = find_flap<Dim>(patch_of_facet, ridges);
    if (flap < 0) return;
    std::vector<bool> is_dropped(draft.facets.size(), false);
    for (std::size_t f = 0; f < draft.facets.size(); ++f) {
      is_dropped[f] = patch_of_facet[f] == flap;
      if (is_dropped[f]) {
        draft.changes.push_back(name_of<Dim>(draft.facets[f]) +
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
