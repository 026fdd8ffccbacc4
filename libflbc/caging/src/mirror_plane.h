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

//! The half of a closed surface with larger coordinates; its border is in the plane. \param nearest
//! minimum distance of vertices from the plane unless they are in it
template <int Dim>
Cage<Dim> cut_half(const Cage<Dim>& surface, const MirrorPlane& plane, double nearest);

//! The closed surface with this half.
template <int Dim>
Cage<Dim> join_halves(const Cage<Dim>& half, const MirrorPlane& plane);

}  // namespace flbc
