// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/distance_weights.h"

#include <omp.h>

#include <algorithm>
#include <limits>
#include <type_traits>
#include <vector>

#include "base/instantiate.h"
#include "base/parallel.h"
#include "base/shape_checks.h"
#include "base/stage_progress.h"
#include "mesh/check_topology.h"
#include "problem/geodesic/bounded_distances.h"
#include "problem/geodesic/march.h"

namespace flbc {
namespace {

using distance::EikonalMesh;
using distance::March;

// A block of rows of a DistanceMatrix. Writing single rows directly would fetch one cache line per
// value.
class SourceRows {
 public:
  // \param num_rows  rows in a block \param num_points  V
  SourceRows(Index num_rows, Index num_points)
      : num_rows_(num_rows), numbers_(static_cast<std::size_t>(num_rows) * num_points) {}

  // The distance of one source and point. \param row  in [0, num_rows)
  float& operator()(Index row, Index point) {
    return numbers_[static_cast<std::size_t>(point) * num_rows_ + row];
  }

  // Copies the first rows. \param first  first row in the result
  void write(Index first, Index count, DistanceMatrix& result) const {
    for (Eigen::Index v = 0; v < result.cols(); ++v) {
      std::copy_n(numbers_.data() + v * num_rows_, count, result.col(v).data() + first);
    }
  }

 private:
  Index num_rows_;
  std::vector<float> numbers_;  // num_rows_ of each point
};

// Measures distances from all sources in parallel; each thread takes a few sources at a time.
// \param make_measure  makes a function per thread, which is called with a source, rows, and the
// row for its distances
// \return num_sources x num_points
template <class MakeMeasure>
DistanceMatrix by_source_rows(Index num_sources, Index num_points,
                              const MakeMeasure& make_measure) {
  constexpr Index kMost = 16;      // a cache line
  constexpr Index kPerThread = 4;  // for load balance
  const Index num_rows =
      std::clamp<Index>(num_sources / (kPerThread * omp_get_max_threads()), 1, kMost);
  DistanceMatrix result(num_sources, num_points);
  LoopProgress progress(num_sources);
  struct Scratch {
    SourceRows rows;
    std::invoke_result_t<const MakeMeasure&> measure;
  };
  const auto make_scratch = [&] { return Scratch{{num_rows, num_points}, make_measure()}; };
  parallel_for_chunks((num_sources + num_rows - 1) / num_rows, 1, make_scratch,
                      [&](Index block, auto& scratch) {
                        const Index first = block * num_rows;
                        const Index count = std::min(num_rows, num_sources - first);
                        for (Index row = 0; row < count; ++row) {
                          scratch.measure(first + row, scratch.rows, row);
                          progress.add(1);
                        }
                        scratch.rows.write(first, count, result);
                      });
  return result;
}

constexpr std::size_t kWholeSources = 4;
constexpr float kEverywhere = std::numeric_limits<float>::infinity();

// Runs a march until all given vertices have been passed, and slightly farther, because the last
// ones may still be improved.
class UntilPassed {
 public:
  UntilPassed(Index num_vertices, float margin) : margin_(margin), wanted_by_(num_vertices, -1) {}

  void want(Index source, const VertexItems<Index>::Range& vertices) {
    source_ = source;
    num_left_ = static_cast<Index>(vertices.end() - vertices.begin());
    farthest_ = 0;
    has_stopped_ = false;
    for (const Index v : vertices) wanted_by_[v] = source;
  }

  bool operator()(Index vertex, float distance) {
    if (wanted_by_[vertex] == source_) {
      wanted_by_[vertex] = -1;
      --num_left_;
      farthest_ = std::max(farthest_, distance);
    }
    has_stopped_ = num_left_ == 0 && distance > farthest_ + margin_;
    return !has_stopped_;
  }

  // The distance up to which everything is known after the march.
  float reach() const { return has_stopped_ ? farthest_ : kEverywhere; }

 private:
  const float margin_;
  std::vector<Index> wanted_by_;
  Index source_ = -1;
  Index num_left_ = 0;
  float farthest_ = 0;
  bool has_stopped_ = false;
};

// Distances of some sources, measured everywhere.
struct Whole {
  std::vector<Index> sources;  // indices of the sources
  DistanceMatrix distances;    // one column for each
};

// Farthest-point sampling of the sources: each one is farthest from the previous ones.
template <int Dim>
Whole measure_everywhere(const EikonalMesh<Dim>& eikonal, const std::vector<Index>& sources) {
  const auto count = std::min<std::size_t>(kWholeSources, sources.size());
  Whole whole;
  whole.distances.resize(eikonal.num_vertices(), static_cast<Index>(count));
  March<Dim> march(eikonal);
  std::vector<float> to_nearest(sources.size(), kEverywhere);
  Index i = 0;
  while (whole.sources.size() < count) {
    const auto& arrivals = march.run(sources[i]);
    auto distances = whole.distances.col(static_cast<Index>(whole.sources.size()));
    for (Index v = 0; v < eikonal.num_vertices(); ++v) distances[v] = arrivals[v].distance;
    whole.sources.push_back(i);
    for (std::size_t k = 0; k < sources.size(); ++k) {
      to_nearest[k] = std::min(to_nearest[k], distances[sources[k]]);
    }
    i = static_cast<Index>(std::max_element(to_nearest.begin(), to_nearest.end()) -
                           to_nearest.begin());
  }
  return whole;
}

}  // namespace

template <int Dim>
DistanceMatrix geodesic_distances(const DomainMesh<Dim>& mesh, const MeshTopology<Dim>& topology,
                                  const std::vector<Index>& sources) {
  check_elements(mesh.points, mesh.cells, kMeshNames);
  check_topology(mesh, topology);
  const auto num_sources = static_cast<Index>(sources.size());
  check_indices(
      Eigen::Map<const Eigen::Matrix<Index, 1, Eigen::Dynamic>>(sources.data(), 1, num_sources),
      mesh.num_vertices(), {"list", "source", "vertex", "vertices"});
  const EikonalMesh<Dim> eikonal(mesh, topology);
  return by_source_rows(num_sources, mesh.num_vertices(), [&] {
    return [&, march = March<Dim>(eikonal)](Index i, SourceRows& rows, Index row) mutable {
      const auto& arrivals = march.run(sources[i]);
      for (Index v = 0; v < mesh.num_vertices(); ++v) rows(row, v) = arrivals[v].distance;
    };
  });
}

template <int Dim>
BoundedDistances bounded_distances(const DomainMesh<Dim>& mesh, const MeshTopology<Dim>& topology,
                                   const std::vector<Index>& sources,
                                   const VertexItems<Index>& needed) {
  const EikonalMesh<Dim> eikonal(mesh, topology);
  const auto num_sources = static_cast<Index>(sources.size());
  const Eigen::Matrix<float, Dim, Eigen::Dynamic> points = mesh.points.template cast<float>();
  const auto whole = measure_everywhere(eikonal, sources);
  BoundedDistances result{{}, Eigen::VectorXf::Zero(num_sources)};
  for (const Index i : whole.sources) result.reach[i] = kEverywhere;
  result.distances = by_source_rows(num_sources, mesh.num_vertices(), [&] {
    return [&, march = March<Dim>(eikonal),
            until = UntilPassed(mesh.num_vertices(), eikonal.mean_length)](
               Index i, SourceRows& rows, Index row) mutable {
      if (result.reach[i] == kEverywhere) return;  // its row is filled below
      until.want(i, needed.of(i));
      const auto& arrivals = march.run(sources[i], until);
      const float reach = result.reach[i] = until.reach();
      for (Index v = 0; v < mesh.num_vertices(); ++v) {
        const float arrival = arrivals[v].distance;
        rows(row, v) = arrival <= reach
                           ? arrival
                           : std::max(reach, (points.col(v) - points.col(sources[i])).norm());
      }
    };
  });
  for (std::size_t k = 0; k < whole.sources.size(); ++k) {
    result.distances.row(whole.sources[k]) = whole.distances.col(static_cast<Index>(k)).transpose();
  }
  return result;
}

FLBC_INSTANTIATE_FUNCTION(geodesic_distances)
FLBC_INSTANTIATE_FUNCTION(bounded_distances)

}  // namespace flbc
