// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! The cage: control points and the facets between them.
#pragma once

#include <string>
#include <vector>

#include "flbc/bounding_box.h"
#include "flbc/types.h"

namespace flbc {

//! A closed polygon (2D: one or several closed polylines, the inner ones being holes) or a closed
//! triangulated surface (3D). The coordinates do not depend on the orientation of loops or shells,
//! as long as each is consistent.
template <int Dim>
struct Cage {
  PointList<Dim> points;  //!< Dim x n, the control points c_1 .. c_n
  FacetList<Dim> facets;  //!< Dim x m, edges or triangles

  //! Number of control points n.
  Index size() const { return static_cast<Index>(points.cols()); }
};

//! One defect of a cage or mesh, ready to be shown.
struct Defect {
  std::string message;            //!< what is wrong, with element numbers (from 0) and coordinates
  std::vector<Index> vertices{};  //!< the vertices concerned
  std::vector<Index> facets{};    //!< the facets concerned
};

//! Checks everything that can be decided without constructing intersections: number and finiteness
//! of control points, a size from 1e-30 to 1e30 and a distance from the origin of at most 1e9 times
//! the size, facet indices, duplicate and unreferenced points, edges of length zero and
//! degenerate triangles, open or non-manifold edges and vertices, inconsistent orientation (3D).
//! In 2D the orientation of the polyline's edges is free.
//! \param cage  any
//! \param limit  largest number of defects to look for
//! \return at most `limit` defects, the most fundamental first; empty for a sound cage.
template <int Dim>
std::vector<Defect> find_defects(const Cage<Dim>& cage, std::size_t limit = 16);

//! Checks that a cage is sound.
//! \param cage  any
//! \throws InputError with the first defect found by find_defects().
template <int Dim>
void validate(const Cage<Dim>& cage);

extern template struct Cage<2>;
extern template struct Cage<3>;

}  // namespace flbc
