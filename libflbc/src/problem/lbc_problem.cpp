// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/lbc_problem.h"

#include <utility>

#include "flbc/domain_mesh.h"
#include "problem/problem_geometry.h"

namespace flbc {
namespace {

template <int Dim>
LbcProblem<Dim> with_phi(LbcProblem<Dim> problem, DistanceScheme scheme) {
  set_phi(problem, scheme);
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

#define FLBC_INSTANTIATE(Dim)                                                          \
  template LbcProblem<Dim> make_problem(Cage<Dim>, DomainMesh<Dim>, DistanceScheme);   \
  template LbcProblem<Dim> make_problem(Cage<Dim>, DomainMesh<Dim>, MeshTopology<Dim>, \
                                        DistanceScheme);
FLBC_INSTANTIATE(2)
FLBC_INSTANTIATE(3)
#undef FLBC_INSTANTIATE

}  // namespace flbc
