// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Which points of a model can be vertices of a mesh of its cage's interior.
#pragma once

#include <vector>

#include "flbc/cage.h"

namespace flbc {

//! Points for MeshingOptions::embedded_points, and which of the given points each one stands for.
template <int Dim>
struct EmbeddablePoints {
  PointList<Dim> points;      //!< strictly inside the cage and distinct, in the order given
  std::vector<Index> number;  //!< of each point given among them; -1 = on the cage or outside
};

//! Leaves out points that a mesher could not tell from the cage, from a control point or from each
//! other (closer than 1e-8 of the cage's size), and points outside.
//! \param cage  has passed validate()
//! \param points  Dim x P, finite, in the units of the cage
template <int Dim>
EmbeddablePoints<Dim> embeddable_points(const Cage<Dim>& cage, const PointList<Dim>& points);

}  // namespace flbc
