// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! The scale on which problems are solved, that of the literature.
#pragma once

#include "flbc/domain_mesh.h"

namespace flbc {

//! Puts the centre of a domain's bounding box at the origin and its farthest vertex at radius 250.
template <int Dim>
struct DomainScale {
  //! \param mesh  of the domain
  explicit DomainScale(const DomainMesh<Dim>& mesh)
      : center((mesh.points.rowwise().minCoeff() + mesh.points.rowwise().maxCoeff()) / 2),
        factor(kRadius / (mesh.points.colwise() - center).colwise().norm().maxCoeff()) {}

  //! Scales points of the domain. \param points  Dim x any number
  PointList<Dim> operator()(const PointList<Dim>& points) const {
    return factor * (points.colwise() - center);
  }

  static constexpr double kRadius = 250;
  Vector<Dim> center;  //!< of the bounding box
  double factor;       //!< scaled length / original length
};

}  // namespace flbc
