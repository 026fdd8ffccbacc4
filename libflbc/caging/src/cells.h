// SPDX-License-Identifier: BSD-3-Clause
// The cells into which facets divide space, and the facets that bound the solid.
#pragma once

#include <map>
#include <set>
#include <vector>

#include "caging/repair_steps.h"

namespace flbc {

//! Cuts facets where they cross or touch others, in exact arithmetic. Facets then meet only at
//! common corners and edges, up to rounding; where facets overlap, one remains for each of them.
//! Points of crossings are appended.
void cut_at_crossings(CageDraft<2>& draft);
void cut_at_crossings(CageDraft<3>& draft);

//! 3D: cuts triangles that overlap in a plane, within the tolerance, into common pieces. Points of
//! crossings are appended.
void cut_where_facets_overlap(CageDraft<2>& draft);
void cut_where_facets_overlap(CageDraft<3>& draft);

//! Numbers the parts that are connected by ridges, and measures them. \param shells  per original
//! facet: its closed shell, -1: none. Different ones that only touch stay apart. May be empty
//! \return per part: several times its area or volume, negative if its normals are inward
template <int Dim>
std::map<Index, double> number_parts(CageDraft<Dim>& draft, const std::vector<Index>& shells);

//! Removes facets with the inside on both sides, and orients the others with outward normals. The
//! inside of a part is what it separates from infinity. A part inside another one is its cavity,
//! unless it touches it from within and is oriented alike; otherwise parts are united.
//! \param draft  its facets meet only at common corners and edges \param measures  of its parts
//! \param open  the parts that need not be closed
//! \return false if a facet has the outside on both sides, because it belongs to an open part, or if
//! another part is not closed, because cleaning has opened it, or rounding has put facets in
//! another order around a ridge
template <int Dim>
bool keep_boundary(CageDraft<Dim>& draft, const std::map<Index, double>& measures,
                   const std::set<Index>& open);

//! Control points at which the solid only touches itself get a copy for each of its corners there,
//! at a distance that is visible to meshers.
//! \param draft  with outward normals
template <int Dim>
void split_touching_corners(CageDraft<Dim>& draft);

}  // namespace flbc
