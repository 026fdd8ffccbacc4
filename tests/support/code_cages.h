// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Cages made in code, the same way in 2D and 3D.
#pragma once

#include <cmath>

#include "flbc/cage.h"

namespace flbc::testing {

//! An axis-parallel box: 4 edges counterclockwise in 2D, 12 triangles outward in 3D. Corner k has
//! bit `axis` of k set where it is at the high side.
template <int Dim>
Cage<Dim> box_cage(const Vector<Dim>& low, const Vector<Dim>& high) {
  Cage<Dim> cage;
  cage.points.resize(Dim, 1 << Dim);
  for (int corner = 0; corner < (1 << Dim); ++corner) {
    for (int axis = 0; axis < Dim; ++axis) {
      cage.points(axis, corner) = (corner >> axis) & 1 ? high(axis) : low(axis);
    }
  }
  if constexpr (Dim == 2) {
    cage.facets.resize(2, 4);
    cage.facets << 0, 1, 3, 2,  //
        1, 3, 2, 0;
  } else {
    cage.facets.resize(3, 12);
    cage.facets << 0, 0, 4, 4, 0, 0, 2, 2, 0, 0, 1, 1,  //
        2, 3, 5, 7, 1, 5, 6, 7, 4, 6, 3, 7,             //
        3, 1, 7, 6, 5, 4, 7, 3, 6, 2, 7, 5;
  }
  return cage;
}

//! From (low, ..) to (high, ..).
template <int Dim>
Cage<Dim> box_cage(double low, double high) {
  return box_cage<Dim>(Vector<Dim>::Constant(low), Vector<Dim>::Constant(high));
}

//! A box around the origin with sides of length 2 * half.
template <int Dim>
Cage<Dim> box_cage(double half) {
  return box_cage<Dim>(-half, half);
}

//! A closed loop through the points in order.
inline Cage<2> loop(const PointList<2>& points) {
  Cage<2> cage{points, FacetList<2>(2, points.cols())};
  const auto n = static_cast<Index>(points.cols());
  for (Index i = 0; i < n; ++i) cage.facets.col(i) << i, (i + 1) % n;
  return cage;
}

//! On the unit circle; every second corner at another radius.
inline Cage<2> regular_polygon(Index corners, double second_radius = 1) {
  PointList<2> points(2, corners);
  for (Index i = 0; i < corners; ++i) {
    const double angle = 2 * 3.14159265358979323846 * i / corners;
    points.col(i) << std::cos(angle), std::sin(angle);
    if (i % 2 == 1) points.col(i) *= second_radius;
  }
  return loop(points);
}

//! Both cages in one: an inner one becomes a hole or cavity, its orientation does not matter.
template <int Dim>
Cage<Dim> join(const Cage<Dim>& a, const Cage<Dim>& b) {
  Cage<Dim> both;
  both.points.resize(Dim, a.size() + b.size());
  both.points << a.points, b.points;
  both.facets.resize(Dim, a.facets.cols() + b.facets.cols());
  both.facets << a.facets, (b.facets.array() + a.size()).matrix();
  return both;
}

//! All facets reversed.
template <int Dim>
Cage<Dim> reversed(Cage<Dim> cage) {
  cage.facets.row(0).swap(cage.facets.row(1));
  return cage;
}

//! The cage without one facet.
template <int Dim>
Cage<Dim> without_facet(const Cage<Dim>& cage, Index facet) {
  Cage<Dim> open = cage;
  open.facets.col(facet) = open.facets.col(open.facets.cols() - 1);
  open.facets.conservativeResize(Dim, cage.facets.cols() - 1);
  return open;
}

}  // namespace flbc::testing
