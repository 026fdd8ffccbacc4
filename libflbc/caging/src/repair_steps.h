// SPDX-License-Identifier: BSD-3-Clause
// The steps of repair_cage(). Each reports its changes.
#pragma once

#include <string>
#include <vector>

#include "flbc/cage.h"
#include "meshing/cgal/exact_predicates.h"

namespace flbc {

//! Lengths up to this fraction of cage size count as zero.
constexpr double kMergeTolerance = 1e-6;

template <int Dim>
struct CageDraft {
  struct Facet {
    FacetCorners<Dim> corners;
    Index number;            //!< original index; -1: new
    Index part = 0;          //!< see number_parts()
    bool is_double = false;  //!< whether it stands for several of its part
  };
  PointList<Dim> points;           //!< original points, then new ones
  std::vector<Facet> facets;       //!< remaining facets
  std::vector<Index> merged_into;  //!< per control point: the control point it was merged into
  std::vector<std::string> changes{};
  double tolerance = kMergeTolerance;
};

//! "triangle 3".
template <int Dim>
std::string name_of_facet(Index number) {
  const std::string kind = Dim == 2 ? "edge" : "triangle";
  return number < 0 ? "a new " + kind : kind + " " + std::to_string(number);
}

template <int Dim>
CageDraft<Dim> draft_of(const Cage<Dim>& cage);

//! Merges control points within the tolerance into the first of them.
template <int Dim>
void merge_close_points(CageDraft<Dim>& draft);

//! Splits facets at control points that lie on their edges (2D: on them), within the tolerance.
//! Triangles without area go.
void split_at_points(CageDraft<2>& draft);
void split_at_points(CageDraft<3>& draft);

//! Removes facets with repeated corners.
template <int Dim>
void drop_degenerate_facets(CageDraft<Dim>& draft);

//! Keeps only the first of the facets of a part with the same corners.
template <int Dim>
void drop_repeated_facets(CageDraft<Dim>& draft);

//! Where more than two facets meet, removes facets of parts with an open border, smallest part
//! first. \param only_double  others stay
template <int Dim>
void drop_flaps(CageDraft<Dim>& draft, bool only_double);

//! Orients neighboring triangles consistently, like the majority of their shell. No effect in 2D.
void orient_alike(CageDraft<2>& draft);
void orient_alike(CageDraft<3>& draft);

//! 2D: an edge between the ends of every open line. 3D: triangles of least area in open loops of up
//! to 64 edges.
void close_holes(CageDraft<2>& draft);
void close_holes(CageDraft<3>& draft);

}  // namespace flbc
