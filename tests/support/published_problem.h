// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Problems in the unit of length of publications, for iterations with published penalties.
#pragma once

#include "flbc/lbc_problem.h"

namespace flbc::testing {

//! make_problem() with the farthest vertex at radius 250 about the center of the bounding box.
template <int Dim>
LbcProblem<Dim> published_problem(const Cage<Dim>& cage, const DomainMesh<Dim>& mesh,
                                  DistanceScheme scheme) {
  auto problem = make_problem(cage, mesh, scheme, 0);
  const Vector<Dim> center =
      (mesh.points.rowwise().minCoeff() + mesh.points.rowwise().maxCoeff()) / 2;
  problem.scale = 250 / (mesh.points.colwise() - center).colwise().norm().maxCoeff();
  problem.cage.points = problem.scale * (cage.points.colwise() - center);
  problem.mesh.points = problem.scale * (mesh.points.colwise() - center);
  return problem;
}

}  // namespace flbc::testing
