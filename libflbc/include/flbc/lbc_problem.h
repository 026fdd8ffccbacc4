// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! The discretised problem (7)-(10) of the paper, immutable once made.
#pragma once

#include "flbc/boundary_values.h"
#include "flbc/cage.h"
#include "flbc/distance_weights.h"
#include "flbc/domain_mesh.h"

namespace flbc {

//! Everything the solvers read. Geometry is centred and scaled as in the literature, whose
//! penalties and thresholds have a meaning only there (published_penalty.h); weights do not depend
//! on it.
template <int Dim>
struct LbcProblem {
  Cage<Dim> cage;                //!< scaled, n control points
  DomainMesh<Dim> mesh;          //!< scaled, V vertices and F cells
  MeshTopology<Dim> topology;    //!< of the mesh
  BoundaryValues<Dim> boundary;  //!< the weights that are known (properties 4 and 5 of the paper)
  WeightFunctions phi;           //!< n x F: the weight functions of total variation
  double scale = 1;              //!< scaled length / original length

  //! n.
  Index num_control_points() const { return cage.size(); }
};

//! Sets a problem up: topology, boundary values, phi.
//! \param cage  n control points
//! \param mesh  V vertices, a mesh of the cage's interior (see normalize_and_validate)
//! \param scheme  growth of phi with the geodesic distance
//! \throws InputError if mesh and cage do not belong together, naming the element, or the mesh has
//! several parts; SolverError if distances cannot be computed
template <int Dim>
LbcProblem<Dim> make_problem(Cage<Dim> cage, DomainMesh<Dim> mesh, DistanceScheme scheme);

//! The same with facets that are known already, in the caller's order, as a half-edge mesh has
//! them.
//! \param cage  n control points
//! \param mesh  V vertices, a mesh of the cage's interior
//! \param topology  of the mesh
//! \param scheme  growth of phi with the geodesic distance
//! \throws InputError, SolverError as above
template <int Dim>
LbcProblem<Dim> make_problem(Cage<Dim> cage, DomainMesh<Dim> mesh, MeshTopology<Dim> topology,
                             DistanceScheme scheme);

//! The same with boundary values that are known already, as they are after control points and
//! vertices have moved together.
//! \param cage  n control points
//! \param mesh  V vertices, those of the boundary on the cage as `boundary` says
//! \param topology  of the mesh
//! \param boundary  of the mesh
//! \param scheme  growth of phi with the geodesic distance
//! \throws InputError if the mesh has several parts, SolverError as above
template <int Dim>
LbcProblem<Dim> make_problem(Cage<Dim> cage, DomainMesh<Dim> mesh, MeshTopology<Dim> topology,
                             BoundaryValues<Dim> boundary, DistanceScheme scheme);

}  // namespace flbc
