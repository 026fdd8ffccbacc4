// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! The scale on which problems are solved: the size of the cage is the unit of length.
#pragma once

#include "flbc/bounding_box.h"
#include "flbc/cage.h"

namespace flbc {

//! Puts the center of a cage's bounding box at the origin and makes its diagonal 1.
template <int Dim>
struct UnitScale {
  explicit UnitScale(const Cage<Dim>& cage)
      : center((cage.points.rowwise().minCoeff() + cage.points.rowwise().maxCoeff()) / 2),
        factor(1 / bounding_box_diagonal(cage.points)) {}

  //! Scales points of the domain. \param points  Dim x any number
  PointList<Dim> operator()(const PointList<Dim>& points) const {
    return factor * (points.colwise() - center);
  }

  Vector<Dim> center;  //!< of the bounding box
  double factor;       //!< scaled length / original length
};

}  // namespace flbc
