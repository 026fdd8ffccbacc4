// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/lbc_problem.h"

#include <utility>

#include "flbc/domain_mesh.h"
#include "problem/problem_geometry.h"

namespace flbc {
namespace {

template <int Dim>
LbcProblem<Dim> with_phi(LbcProblem<Dim> problem, DistanceScheme scheme) {
  problem.phi = {scheme, distances_for(scheme, problem), problem.mesh,
                 problem.num_control_points()};
  return problem;
}

}  // namespace

template <int Dim>
LbcProblem<Dim> make_problem(Cage<Dim> cage, DomainMesh<Dim> mesh, DistanceScheme scheme) {
  require_connected(mesh);
  return with_phi(make_geometry(std::move(cage), std::move(mesh)), scheme);
}

template <int Dim>
LbcProblem<Dim> make_problem(Cage<Dim> cage, DomainMesh<Dim> mesh, MeshTopology<Dim> topology,
                             DistanceScheme scheme) {
  require_connected(mesh);
  return with_phi(make_geometry(std::move(cage), std::move(mesh), std::move(topology)), scheme);
}

template <int Dim>
LbcProblem<Dim> make_problem(Cage<Dim> cage, DomainMesh<Dim> mesh, MeshTopology<Dim> topology,
                             BoundaryValues<Dim> boundary, DistanceScheme scheme) {
  require_connected(mesh);
  return with_phi(
      make_geometry(std::move(cage), std::move(mesh), std::move(topology), std::move(boundary)),
      scheme);
}

#define FLBC_INSTANTIATE(Dim)                                                          \
  template LbcProblem<Dim> make_problem(Cage<Dim>, DomainMesh<Dim>, DistanceScheme);   \
  template LbcProblem<Dim> make_problem(Cage<Dim>, DomainMesh<Dim>, MeshTopology<Dim>, \
                                        DistanceScheme);                               \
  template LbcProblem<Dim> make_problem(Cage<Dim>, DomainMesh<Dim>, MeshTopology<Dim>, \
                                        BoundaryValues<Dim>, DistanceScheme);
FLBC_INSTANTIATE(2)
FLBC_INSTANTIATE(3)
#undef FLBC_INSTANTIATE

}  // namespace flbc
