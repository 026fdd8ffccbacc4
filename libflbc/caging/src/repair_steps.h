// SPDX-License-Identifier: BSD-3-Clause
// The single repairs of which repair_cage() is made. Each says what it has done.
#pragma once

#include <string>
#include <vector>

#include "caging/cgal/exact_predicates.h"
#include "flbc/cage.h"

namespace flbc {

//! A cage under repair.
template <int Dim>
struct CageDraft {
  struct Facet {
    FacetCorners<Dim> corners;
    Index number;  //!< that it had at first; -1: it is new
  };
  PointList<Dim> points;           //!< as they were
  std::vector<Facet> facets;       //!< that are left
  std::vector<Index> merged_into;  //!< the control point that stands for each one
  std::vector<std::string> changes{};
};

template <int Dim>
CageDraft<Dim> draft_of(const Cage<Dim>& cage);

//! Control points nearer than a millionth of the cage's size become the first of them.
template <int Dim>
void merge_close_points(CageDraft<Dim>& draft);

//! Facets with repeated corners go; triangles whose corners lie on one line go, and the one at
//! their longest edge gets a corner there.
template <int Dim>
void drop_degenerate_facets(CageDraft<Dim>& draft);

//! Of facets with the same corners only the first stays.
template <int Dim>
void drop_repeated_facets(CageDraft<Dim>& draft);

//! Where more than two facets meet, those that belong to a part with an open border go, the
//! smallest part first.
template <int Dim>
void drop_flaps(CageDraft<Dim>& draft);

//! Neighbouring triangles become oriented alike, as most of their shell are. Nothing in 2D.
void orient_alike(CageDraft<2>& draft);
void orient_alike(CageDraft<3>& draft);

//! 2D: an edge between the ends of every open line. 3D: triangles of least area in open loops of up
//! to 64 edges.
void close_holes(CageDraft<2>& draft);
void close_holes(CageDraft<3>& draft);

}  // namespace flbc
