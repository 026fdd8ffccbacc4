// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/lbc_problem.h"

#include <utility>

#include "flbc/domain_mesh.h"
#include "problem/problem_geometry.h"
#include "problem/unit_scale.h"

namespace flbc {
namespace {

template <int Dim>
LbcProblem<Dim> complete(LbcProblem<Dim> geometry, DistanceScheme scheme, double smoothness) {
  geometry.smoothness = smoothness;
  set_phi(geometry, scheme);
  return geometry;
}

}  // namespace

template <int Dim>
LbcProblem<Dim> make_geometry(Cage<Dim> cage, DomainMesh<Dim> mesh, MeshTopology<Dim> topology,
                              BoundaryValues<Dim> boundary) {
  const UnitScale<Dim> scale(cage);
  mesh.points = scale(mesh.points);
  cage.points = scale(cage.points);
  return {std::move(cage), std::move(mesh), std::move(topology), std::move(boundary), {},
          scale.factor};
}

template <int Dim>
LbcProblem<Dim> make_geometry(Cage<Dim> cage, DomainMesh<Dim> mesh, MeshTopology<Dim> topology) {
  validate(mesh, topology);
  // Before scaling, so that messages contain unscaled coordinates.
  auto boundary = boundary_values(cage, mesh, topology);
  return make_geometry(std::move(cage), std::move(mesh), std::move(topology), std::move(boundary));
}

template <int Dim>
LbcProblem<Dim> make_geometry(Cage<Dim> cage, DomainMesh<Dim> mesh) {
  auto topology = build_topology(mesh);
  return make_geometry(std::move(cage), std::move(mesh), std::move(topology));
}

template <int Dim>
DistanceMatrix distances_for(DistanceScheme scheme, const LbcProblem<Dim>& problem) {
  if (scheme == DistanceScheme::kConstant) return {};
  return geodesic_distances(problem.mesh, problem.topology, problem.boundary.control_vertices);
}

template <int Dim>
LbcProblem<Dim> make_problem(Cage<Dim> cage, DomainMesh<Dim> mesh, DistanceScheme scheme,
                             double smoothness) {
  validate(mesh);
  require_connected(mesh);
  return complete(make_geometry(std::move(cage), std::move(mesh)), scheme, smoothness);
}

template <int Dim>
LbcProblem<Dim> make_problem(Cage<Dim> cage, DomainMesh<Dim> mesh, MeshTopology<Dim> topology,
                             DistanceScheme scheme, double smoothness) {
  validate(mesh);
  require_connected(mesh);
  return complete(make_geometry(std::move(cage), std::move(mesh), std::move(topology)), scheme,
                  smoothness);
}

#define FLBC_INSTANTIATE(Dim)                                                                \
  template LbcProblem<Dim> make_geometry(Cage<Dim>, DomainMesh<Dim>, MeshTopology<Dim>,      \
                                         BoundaryValues<Dim>);                               \
  template LbcProblem<Dim> make_geometry(Cage<Dim>, DomainMesh<Dim>, MeshTopology<Dim>);     \
  template LbcProblem<Dim> make_geometry(Cage<Dim>, DomainMesh<Dim>);                        \
  template DistanceMatrix distances_for(DistanceScheme, const LbcProblem<Dim>&);             \
  template LbcProblem<Dim> make_problem(Cage<Dim>, DomainMesh<Dim>, DistanceScheme, double); \
  template LbcProblem<Dim> make_problem(Cage<Dim>, DomainMesh<Dim>, MeshTopology<Dim>,       \
                                        DistanceScheme, double);
FLBC_INSTANTIATE(2)
FLBC_INSTANTIATE(3)
#undef FLBC_INSTANTIATE

}  // namespace flbc
