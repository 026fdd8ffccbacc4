// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! The discretised problem (7)-(10) of the paper, immutable once made.
#pragma once

#include "flbc/boundary_values.h"
#include "flbc/cage.h"
#include "flbc/distance_weights.h"
#include "flbc/domain_mesh.h"

namespace flbc {

//! Everything the solvers read. Geometry is centred and scaled so that the farthest vertex lies at
//! radius 250, the scale on which the paper's penalties and thresholds have a meaning; weights do
//! not depend on it.
template <int Dim>
struct LbcProblem {
  Cage<Dim> cage;                //!< scaled
  DomainMesh<Dim> mesh;          //!< scaled
  MeshTopology<Dim> topology;    //!< of the mesh
  BoundaryValues<Dim> boundary;  //!< what is known of the weights
  Eigen::MatrixXd phi;           //!< n x F, in [0, 1]
  double scale = 1;              //!< scaled length / original length

  //! n.
  Index num_control_points() const { return cage.size(); }
};

//! \param mesh  a mesh of the cage's interior (see normalize_and_validate)
//! \throws InputError if mesh and cage do not belong together, SolverError
template <int Dim>
LbcProblem<Dim> make_problem(Cage<Dim> cage, DomainMesh<Dim> mesh, DistanceScheme scheme);

//! The same with facets that are known already, in the caller's order, as a half-edge mesh has
//! them. \param topology  of the mesh
template <int Dim>
LbcProblem<Dim> make_problem(Cage<Dim> cage, DomainMesh<Dim> mesh, MeshTopology<Dim> topology,
                             DistanceScheme scheme);

//! The same with boundary values that are known already, as they are after control points and
//! vertices have moved together. \param boundary  of the mesh, whose vertices lie on the cage
//! accordingly
template <int Dim>
LbcProblem<Dim> make_problem(Cage<Dim> cage, DomainMesh<Dim> mesh, MeshTopology<Dim> topology,
                             BoundaryValues<Dim> boundary, DistanceScheme scheme);

}  // namespace flbc
