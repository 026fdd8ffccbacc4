// SPDX-License-Identifier: BSD-3-Clause
// Sets up a problem without phi, which can be made from exact or interpolated distances.
#pragma once

#include <utility>
#include <vector>

#include "flbc/lbc_problem.h"

namespace flbc {

//! Scales cage and mesh; phi stays empty. \param boundary  of the mesh
template <int Dim>
LbcProblem<Dim> make_geometry(Cage<Dim> cage, DomainMesh<Dim> mesh, MeshTopology<Dim> topology,
                              BoundaryValues<Dim> boundary);

//! The same, computing boundary values first. \throws InputError as make_problem()
template <int Dim>
LbcProblem<Dim> make_geometry(Cage<Dim> cage, DomainMesh<Dim> mesh, MeshTopology<Dim> topology);

//! The same, enumerating facets first. \throws InputError as make_problem()
template <int Dim>
LbcProblem<Dim> make_geometry(Cage<Dim> cage, DomainMesh<Dim> mesh);

//! As geodesic_distances(), from the nearest vertex of each set.
template <int Dim>
DistanceMatrix distances_from_sets(const DomainMesh<Dim>& mesh, const MeshTopology<Dim>& topology,
                                   const std::vector<std::vector<Index>>& sources);

//! Distances from the control points on the mesh of the problem, n x V; empty for kConstant.
template <int Dim>
DistanceMatrix distances_for(DistanceScheme scheme, const LbcProblem<Dim>& problem);

//! Makes phi from distances, n x V; its reach stays.
template <int Dim>
void set_phi(LbcProblem<Dim>& problem, DistanceScheme scheme, DistanceMatrix distances) {
  auto reach = problem.phi.reach();
  problem.phi = {scheme, std::move(distances), problem.mesh, problem.num_control_points()};
  problem.phi.set_reach(std::move(reach));
}

//! Makes phi from distances on the mesh of the problem.
template <int Dim>
void set_phi(LbcProblem<Dim>& problem, DistanceScheme scheme) {
  set_phi(problem, scheme, distances_for(scheme, problem));
}

//! Raises phi of masked control points next to their masks, in place of an earlier call.
//! \param problem  with phi and masks \param falloff  SolverOptions::falloff
template <int Dim>
void set_falloff(LbcProblem<Dim>& problem, double falloff);

}  // namespace flbc
