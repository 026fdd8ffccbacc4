// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/lbc_problem.h"

#include <utility>

#include "problem/domain_scale.h"

namespace flbc {

template <int Dim>
LbcProblem<Dim> make_problem(Cage<Dim> cage, DomainMesh<Dim> mesh, DistanceScheme scheme) {
  auto topology = build_topology(mesh);
  return make_problem(std::move(cage), std::move(mesh), std::move(topology), scheme);
}

template <int Dim>
LbcProblem<Dim> make_problem(Cage<Dim> cage, DomainMesh<Dim> mesh, MeshTopology<Dim> topology,
                             DistanceScheme scheme) {
  // Before scaling, so that messages give the user's coordinates.
  auto boundary = boundary_values(cage, mesh, topology);
  return make_problem(std::move(cage), std::move(mesh), std::move(topology), std::move(boundary),
                      scheme);
}

template <int Dim>
LbcProblem<Dim> make_problem(Cage<Dim> cage, DomainMesh<Dim> mesh, MeshTopology<Dim> topology,
                             BoundaryValues<Dim> boundary, DistanceScheme scheme) {
  const DomainScale<Dim> scale(mesh);
  mesh.points = scale(mesh.points);
  cage.points = scale(cage.points);
  LbcProblem<Dim> problem{
      std::move(cage), std::move(mesh), std::move(topology), std::move(boundary), {}, scale.factor};
  Eigen::MatrixXd distances;
  if (scheme != DistanceScheme::kConstant) {
    distances =
        geodesic_distances(problem.mesh, problem.topology, problem.boundary.control_vertices);
  }
  problem.phi = distance_weights(scheme, distances, problem.mesh, problem.num_control_points());
  return problem;
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
