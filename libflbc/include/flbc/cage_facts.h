// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Sizes and parts of a sound cage, and which points lie outside it.
#pragma once

#include <vector>

#include "flbc/cage.h"
#include "flbc/types.h"

namespace flbc {

//! Parts, sizes and lengths of a sound cage.
template <int Dim>
struct CageFacts {
  Index parts = 0;              //!< outer loops (2D) or shells (3D)
  Index holes = 0;              //!< loops or shells that bound holes or cavities
  double size = 0;              //!< diagonal of the bounding box
  double measure = 0;           //!< area (2D) or volume (3D) of the interior
  double shortest_edge = 0;     //!< length
  Index shortest_ends[2] = {};  //!< the control points between which it runs
};

//! Measures a cage, in its own units.
//! \param cage  has passed validate() and does not intersect itself
template <int Dim>
CageFacts<Dim> measure_cage(const Cage<Dim>& cage);

//! The place where a cage is nearest to itself: a thin wall, or a facet that is nearly a line.
//! The thinner it is, the more cells a mesh of good quality needs.
struct ThinPlace {
  double distance = 0;  //!< of the control point from the facet, in the cage's units
  Index control_point = -1;
  Index facet = -1;  //!< of which the control point is no corner; -1 if there is none
};

//! The smallest distance of a control point from a facet that it is no corner of. Takes time
//! proportional to their numbers' product.
//! \param cage  has passed validate()
template <int Dim>
ThinPlace thinnest_place(const Cage<Dim>& cage);

//! Where thinnest_place() is below this part of the cage's size, meshing may not end in time.
constexpr double kThin = 1e-3;

//! Points outside a cage by more than kBoundaryTolerance of its size; those inside holes are
//! outside.
//! \param cage  has passed validate()
//! \param points  Dim x P, in the units of the cage
//! \return their indices, ascending
template <int Dim>
std::vector<Index> points_outside(const Cage<Dim>& cage, const PointList<Dim>& points);

//! A connected part of a cage's interior: an outer loop or shell with the holes or cavities in it.
template <int Dim>
struct CagePart {
  Cage<Dim> cage;                     //!< control points and facets in the order of the whole cage
  std::vector<Index> control_points;  //!< per control point: its number there, ascending
};

//! Splits a cage into its parts. A loop or shell in a hole of another one is a part of its own.
//! \param cage  has passed validate() and does not intersect itself
//! \return at least one, in the order of their first control points
template <int Dim>
std::vector<CagePart<Dim>> cage_parts(const Cage<Dim>& cage);

}  // namespace flbc
