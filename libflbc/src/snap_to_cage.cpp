// SPDX-License-Identifier: BSD-3-Clause
#include "facet_locator.h"
#include "flbc/boundary_values.h"

namespace flbc {

template <int Dim>
void snap_to_cage(const Cage<Dim>& cage, const MeshTopology<Dim>& topology, double tolerance,
                  DomainMesh<Dim>& mesh) {
  constexpr double kExact = 1e-12;
  const double size = size_of(cage.points);
  const FacetLocator<Dim> locator(cage, tolerance * size);
  const auto on_boundary = boundary_vertices(topology, mesh.num_vertices());
  for (Index v = 0; v < mesh.num_vertices(); ++v) {
    if (!on_boundary[v]) continue;
    Vector<Dim> point = mesh.points.col(v);
    Eigen::Index nearest = 0;
    const double distance = (cage.points.colwise() - point).colwise().norm().minCoeff(&nearest);
    if (distance <= tolerance * size) {
      mesh.points.col(v) = cage.points.col(nearest);
      continue;
    }
    const auto place = locator.locate(point);
    if (place.facet < 0 || place.distance <= kExact * size) continue;
    point.setZero();
    for (int k = 0; k < Dim; ++k) {
      point += place.coordinates[k] * cage.points.col(cage.facets(k, place.facet));
    }
    mesh.points.col(v) = point;
  }
}

template void snap_to_cage(const Cage<2>&, const MeshTopology<2>&, double, DomainMesh<2>&);
template void snap_to_cage(const Cage<3>&, const MeshTopology<3>&, double, DomainMesh<3>&);

}  // namespace flbc
