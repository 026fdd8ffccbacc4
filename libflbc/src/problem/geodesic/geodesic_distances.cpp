// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/distance_weights.h"

#include <omp.h>

#include <algorithm>
#include <vector>

#include "base/instantiate.h"
#include "base/parallel.h"
#include "base/shape_checks.h"
#include "base/stage_progress.h"
#include "mesh/check_topology.h"
#include "problem/geodesic/march.h"
#include "problem/problem_geometry.h"

namespace flbc {
namespace {

using distance::EikonalMesh;
using distance::March;

}  // namespace

template <int Dim>
DistanceMatrix geodesic_distances(const DomainMesh<Dim>& mesh, const MeshTopology<Dim>& topology,
                                  const std::vector<Index>& sources) {
  check_elements(mesh.points, mesh.cells, kMeshNames);
  check_topology(mesh, topology);
  check_indices(Eigen::Map<const Eigen::Matrix<Index, 1, Eigen::Dynamic>>(
                    sources.data(), 1, static_cast<Index>(sources.size())),
                mesh.num_vertices(), {"list", "source", "vertex", "vertices"});
  std::vector<std::vector<Index>> sets;
  for (const Index source : sources) sets.push_back({source});
  return distances_from_sets(mesh, topology, sets);
}

template <int Dim>
DistanceMatrix distances_from_sets(const DomainMesh<Dim>& mesh, const MeshTopology<Dim>& topology,
                                   const std::vector<std::vector<Index>>& sources) {
  const auto num_sources = static_cast<Index>(sources.size());
  const EikonalMesh<Dim> eikonal(mesh, topology);
  constexpr Index kMost = 16;      // a cache line
  constexpr Index kPerThread = 4;  // for load balance
  const Index num_rows =
      std::clamp<Index>(num_sources / (kPerThread * omp_get_max_threads()), 1, kMost);
  DistanceMatrix result(num_sources, mesh.num_vertices());
  LoopProgress progress(num_sources);
  // Writing single rows of the result would fetch one cache line per value.
  struct Scratch {
    DistanceMatrix rows;
    March<Dim> march;
  };
  const auto make_scratch = [&] {
    return Scratch{DistanceMatrix(num_rows, mesh.num_vertices()), March<Dim>(eikonal)};
  };
  const auto measure = [&](Index block, Scratch& scratch) {
    const Index first = block * num_rows;
    const Index count = std::min(num_rows, num_sources - first);
    for (Index row = 0; row < count; ++row) {
      const auto& arrivals = scratch.march.run(sources[first + row]);
      for (Index v = 0; v < mesh.num_vertices(); ++v) scratch.rows(row, v) = arrivals[v].distance;
      progress.add(1);
    }
    result.middleRows(first, count) = scratch.rows.topRows(count);
  };
  parallel_for_chunks((num_sources + num_rows - 1) / num_rows, 1, make_scratch, measure);
  return result;
}

FLBC_INSTANTIATE_FUNCTION(geodesic_distances)
FLBC_INSTANTIATE_FUNCTION(distances_from_sets)

}  // namespace flbc
