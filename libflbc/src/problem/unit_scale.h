// SPDX-License-Identifier: BSD-3-Clause
// The scale of problems: cage size is the unit of length.
#pragma once

#include "flbc/bounding_box.h"
#include "flbc/cage.h"

namespace flbc {

//! Moves the center of the cage bounding box to the origin and scales its diagonal to 1.
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
