// SPDX-License-Identifier: BSD-3-Clause
// Symmetric cages, represented by half of the surface.
#pragma once

#include "flbc/cage.h"

namespace flbc {

//! A mirror plane (2D: line) normal to an axis. The kept half has larger coordinates.
struct MirrorPlane {
  int axis = -1;  //!< -1: none
  double position = 0;

  bool is_there() const { return axis >= 0; }

  template <class Point>
  bool contains(const Point& point) const {
    return is_there() && point(axis) == position;
  }

  template <class Point>
  Point mirrored(Point point) const {
    point(axis) = 2 * position - point(axis);
    return point;
  }
};

//! Points and facets together with their mirror images as separate facets.
template <int Dim>
Cage<Dim> with_mirror_image(const Cage<Dim>& shape, const MirrorPlane& plane);

//! A model with both halves moved apart, so that a wrap does not join what is on both sides of the
//! plane, such as legs. What crosses the plane is stretched.
struct Parting {
  MirrorPlane plane;
  double width;    //!< by which each side moves
  double nearest;  //!< minimum distance of vertices from the plane unless they are in it
  double overlap;  //!< parts of a wrap are joined if they cross the plane by more than this

  template <int Dim>
  Cage<Dim> part(const Cage<Dim>& shape) const;
  //! The half of a closed surface around the parted shape, moved back to the plane.
  template <int Dim>
  Cage<Dim> joined_half(const Cage<Dim>& surface) const;
};

//! The half of a closed surface with larger coordinates; its border is in the plane. \param nearest
//! minimum distance of vertices from the plane unless they are in it
template <int Dim>
Cage<Dim> cut_half(const Cage<Dim>& surface, const MirrorPlane& plane, double nearest);

//! The surface with a point wherever an edge crosses the plane.
template <int Dim>
Cage<Dim> cut_along(const Cage<Dim>& surface, const MirrorPlane& plane);

//! The closed surface with this half.
template <int Dim>
Cage<Dim> join_halves(const Cage<Dim>& half, const MirrorPlane& plane);

}  // namespace flbc
