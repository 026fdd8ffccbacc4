// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/lbc_problem.h"

#include <algorithm>
#include <utility>
#include <vector>

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
void set_falloff(LbcProblem<Dim>& problem, double falloff) {
  const auto& masks = problem.masks;
  if (falloff == 0 || masks.empty()) return problem.phi.set_falloff({}, {}, problem.mesh);
  std::vector<std::vector<Index>> regions(problem.num_control_points());
  for (const Index v : masks.points()) {
    for (const Index i : masks.forbidden(v)) regions[i].push_back(v);
  }
  std::vector<Index> rows;  // by control point
  std::vector<std::vector<Index>> distinct;
  for (const auto& region : regions) {
    const auto found = std::find(distinct.begin(), distinct.end(), region);
    rows.push_back(region.empty() ? -1 : static_cast<Index>(found - distinct.begin()));
    if (found == distinct.end() && !region.empty()) distinct.push_back(region);
  }
  auto nearness = distances_from_sets(problem.mesh, problem.topology, distinct);
  nearness = (1 - nearness.array() / static_cast<float>(falloff)).max(0);
  problem.phi.set_falloff(std::move(rows), std::move(nearness), problem.mesh);
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
  template void set_falloff(LbcProblem<Dim>&, double);                                       \
  template LbcProblem<Dim> make_problem(Cage<Dim>, DomainMesh<Dim>, DistanceScheme, double); \
  template LbcProblem<Dim> make_problem(Cage<Dim>, DomainMesh<Dim>, MeshTopology<Dim>,       \
                                        DistanceScheme, double);
FLBC_INSTANTIATE(2)
FLBC_INSTANTIATE(3)
#undef FLBC_INSTANTIATE

}  // namespace flbc
