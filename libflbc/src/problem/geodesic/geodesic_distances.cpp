// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/distance_weights.h"

#include "problem/geodesic/march.h"
#include "problem/geodesic/source_rows.h"

namespace flbc {

template <int Dim>
DistanceMatrix geodesic_distances(const DomainMesh<Dim>& mesh, const MeshTopology<Dim>& topology,
                                  const std::vector<Index>& sources) {
  const distance::EikonalMesh<Dim> eikonal(mesh, topology);
  const auto num_sources = static_cast<Index>(sources.size());
  return distance::by_source_rows(num_sources, mesh.num_vertices(), [&] {
    return [&, march = distance::March<Dim>(eikonal)](Index i, distance::SourceRows& rows,
                                                      Index row) mutable {
      const auto& arrivals = march.run(sources[i]);
      for (Index v = 0; v < mesh.num_vertices(); ++v) rows(row, v) = arrivals[v].distance;
    };
  });
}

template DistanceMatrix geodesic_distances(const DomainMesh<2>&, const MeshTopology<2>&,
                                           const std::vector<Index>&);
template DistanceMatrix geodesic_distances(const DomainMesh<3>&, const MeshTopology<3>&,
                                           const std::vector<Index>&);

}  // namespace flbc
