// SPDX-License-Identifier: BSD-3-Clause
// Ridges, where facets meet: control points in 2D, edges in 3D.
#pragma once

#include <algorithm>
#include <array>
#include <map>
#include <vector>

#include "base/union_find.h"
#include "caging/repair_steps.h"

namespace flbc {

//! The control points of a ridge, ascending.
template <int Dim>
using Ridge = std::array<Index, Dim - 1>;

//! The facets at every ridge, as indices in the draft, ascending.
template <int Dim>
using RidgeMap = std::map<Ridge<Dim>, std::vector<Index>>;

//! The ridge of a facet that is opposite to its corner k.
template <int Dim>
Ridge<Dim> ridge_of(const FacetCorners<Dim>& corners, int k) {
  Ridge<Dim> ridge;
  for (int i = 1; i < Dim; ++i) ridge[i - 1] = corners((k + i) % Dim);
  std::sort(ridge.begin(), ridge.end());
  return ridge;
}

template <int Dim>
RidgeMap<Dim> collect_ridges(const CageDraft<Dim>& draft) {
  RidgeMap<Dim> ridges;
  for (std::size_t f = 0; f < draft.facets.size(); ++f) {
    for (int k = 0; k < Dim; ++k) {
      ridges[ridge_of<Dim>(draft.facets[f].corners, k)].push_back(static_cast<Index>(f));
    }
  }
  return ridges;
}

//! Per facet: its patch. Ridges with two facets connect the facets of a patch.
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

}  // namespace flbc
