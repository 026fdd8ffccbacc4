// SPDX-License-Identifier: BSD-3-Clause
// Cages that are symmetric: half of the surface stands for all of it.
#pragma once

#include "flbc/cage.h"

namespace flbc {

//! A plane (2D: line) across an axis, on whose side of larger coordinates a half lies.
struct MirrorPlane {
  int axis = -1;  //!< -1: there is none
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

//! Points and facets together with their mirror images, which count as facets of their own.
template <int Dim>
Cage<Dim> with_mirror_image(const Cage<Dim>& shape, const MirrorPlane& plane);

//! The part of a closed surface on the plane's side of larger coordinates; its border runs in the
//! plane. \param nearest  vertices come no nearer to the plane than this without being in it
template <int Dim>
Cage<Dim> cut_half(const Cage<Dim>& surface, const MirrorPlane& plane, double nearest);

//! The closed surface of which this is half.
template <int Dim>
Cage<Dim> join_halves(const Cage<Dim>& half, const MirrorPlane& plane);

}  // namespace flbc
