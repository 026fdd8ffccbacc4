// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! The unit of length that publications use.
#pragma once

#include "flbc/domain_mesh.h"

namespace flbc::plan {

//! Penalties and thresholds in publications have a meaning for a domain whose farthest vertex is at
//! radius 250 about the center of its bounding box.
//! \return published length / length of this mesh
template <int Dim>
double published_scale(const DomainMesh<Dim>& mesh) {
  constexpr double kRadius = 250;
  const Vector<Dim> center =
      (mesh.points.rowwise().minCoeff() + mesh.points.rowwise().maxCoeff()) / 2;
  return kRadius / (mesh.points.colwise() - center).colwise().norm().maxCoeff();
}

}  // namespace flbc::plan
