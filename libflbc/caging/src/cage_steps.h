// SPDX-License-Identifier: BSD-3-Clause
// Steps of cage_from_model().
#pragma once

#include "caging/enclosure.h"
#include "flbc/cage.h"

namespace flbc {

//! Merges vertices within cells of a grid, as Rossignac and Borrel ("Multi-resolution 3D
//! approximations for rendering complex scenes", 1993). Every vertex moves by less than the
//! diagonal of a cell. \param cell  its side, in model units
//! \return facets without repetition. A vertex that loses all its facets remains as a point
template <int Dim>
Cage<Dim> simplified(const PointList<Dim>& points, const FacetList<Dim>& facets, double cell);

//! \param points  not all in a plane \return outward normals
Cage<3> convex_hull(const PointList<3>& points);

//! A model thinner than this, relative to its size, is flat: a mesh of its volume would have
//! hundreds of thousands of cells.
constexpr double kFlat = 3e-3;

//! A closed surface close to a convex hull.
struct ConvexSurface {
  Cage<3> surface;  //!< with rings of points across a rod, so that it can bend
  double hull_volume;
  double edge_length;  //!< that a cage needs to bend where this has rings
  double offset;       //!< about the distance from the hull
};

//! \param thickness  that the hull of points in a plane gets \return no facets if all points are on
//! a line
ConvexSurface convex_surface(const PointList<3>& points, double thickness);

//! Volume of the solid that triangles bound, within about a percent. They may be open or intersect.
//! Points count as inside if the signed crossings of a line with the triangles before them do not
//! add up to zero. Lines that pass through an opening do not count. The result of an open model is
//! the median of lines along x, y, and z.
//! \return 0 if the triangles bound nothing, or are oriented at random
double solid_volume(const Cage<3>& model, bool is_closed);

//! The model with added points inside it, so that a wrap does not enter it through an opening. Most
//! lines along x, y, and z that pass through no opening must say that a point is inside.
//! \param spacing  of the points
Cage<3> filled(const Cage<3>& model, double spacing);

//! Whether an even number of triangles meet at every edge between two places.
bool is_closed(const Cage<3>& model);

//! A closed surface (2D: lines) around a model, finer than the final cage.
struct WrapSize {
  double alpha;   //!< narrower gaps and hollows are bridged
  double offset;  //!< distance from the model
};

//! Alpha wrapping of Portaneri et al. ("Alpha wrapping with an offset", 2022), by CGAL.
//! \return outward normals; no facets if wrapping failed
Cage<3> wrap(const Enclosure<3>& model, const WrapSize& size);

//! Boundary of the grid cells within the offset of the model. Enclosed cells are filled. \return
//! counterclockwise
Cage<2> wrap(const Enclosure<2>& model, const WrapSize& size);

}  // namespace flbc
