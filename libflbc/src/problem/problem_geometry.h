// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! A problem up to its weight functions phi, which may be made from distances of several kinds.
#pragma once

#include <utility>

#include "flbc/lbc_problem.h"

namespace flbc {

//! Scales cage and mesh; phi stays empty. \param boundary  of the mesh
template <int Dim>
LbcProblem<Dim> make_geometry(Cage<Dim> cage, DomainMesh<Dim> mesh, MeshTopology<Dim> topology,
                              BoundaryValues<Dim> boundary);

//! The same with boundary values sought first. \throws InputError as make_problem()
template <int Dim>
LbcProblem<Dim> make_geometry(Cage<Dim> cage, DomainMesh<Dim> mesh, MeshTopology<Dim> topology);

//! The same with facets enumerated first. \throws InputError as make_problem()
template <int Dim>
LbcProblem<Dim> make_geometry(Cage<Dim> cage, DomainMesh<Dim> mesh);

//! Distances from the control points on the problem's own mesh, n x V; empty for kConstant.
template <int Dim>
DistanceMatrix distances_for(DistanceScheme scheme, const LbcProblem<Dim>& problem);

//! Makes phi of distances, n x V, wherever they come from.
template <int Dim>
void set_phi(LbcProblem<Dim>& problem, DistanceScheme scheme, DistanceMatrix distances) {
  problem.phi = {scheme, std::move(distances), problem.mesh, problem.num_control_points()};
}

//! Makes phi of the distances on the problem's own mesh.
template <int Dim>
void set_phi(LbcProblem<Dim>& problem, DistanceScheme scheme) {
  set_phi(problem, scheme, distances_for(scheme, problem));
}

}  // namespace flbc
