// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Sizes and parts of a valid cage, and the points that lie outside it.
#pragma once

#include <vector>

#include "flbc/cage.h"
#include "flbc/types.h"

namespace flbc {

//! Parts, sizes, and lengths of a valid cage.
template <int Dim>
struct CageFacts {
  Index parts = 0;              //!< outer loops (2D) or shells (3D)
  Index holes = 0;              //!< loops or shells that bound holes or cavities
  double size = 0;              //!< diagonal of the bounding box
  double measure = 0;           //!< area (2D) or volume (3D) of the interior
  double shortest_edge = 0;     //!< length
  Index shortest_ends[2] = {};  //!< control points at its ends
};

//! Measures a cage, in its own units of length.
//! \param cage  has passed validate() and does not intersect itself
template <int Dim>
CageFacts<Dim> measure_cage(const Cage<Dim>& cage);

//! The place where a cage comes closest to itself: a thin wall, or a nearly degenerate facet. A
//! thinner place needs more cells for the same mesh quality.
struct ThinPlace {
  double distance = 0;  //!< from the control point, or in 3D from an edge at it, to the facet
  Index control_point = -1;
  Index facet = -1;  //!< the control point is not one of its corners; -1: none
};

//! The smallest distance from a control point to a facet of which it is not a corner, in cage
//! units. In 3D instead that of two edges which pass each other at less than half of it, as in a
//! flat tetrahedron.
//! \param cage  has passed validate()
template <int Dim>
ThinPlace thinnest_place(const Cage<Dim>& cage);

//! If thinnest_place() is below this fraction of cage size, meshing may exceed its time limit.
constexpr double kThin = 1e-3;

//! Points outside a cage by more than kBoundaryTolerance of its size. Points in holes are outside.
//! \param cage  has passed validate()
//! \param points  Dim x P, in the units of the cage
//! \return their indices, ascending
template <int Dim>
std::vector<Index> points_outside(const Cage<Dim>& cage, const PointList<Dim>& points);

//! A connected part of the cage interior: an outer loop or shell with its holes or cavities.
template <int Dim>
struct CagePart {
  Cage<Dim> cage;                     //!< in the order of the whole cage
  std::vector<Index> control_points;  //!< per control point: its index in the whole cage, ascending
};

//! Splits a cage into its parts. A loop or shell in a hole of another one is a separate part.
//! \param cage  has passed validate() and does not intersect itself
//! \return at least one, in the order of their first control points
template <int Dim>
std::vector<CagePart<Dim>> cage_parts(const Cage<Dim>& cage);

}  // namespace flbc
