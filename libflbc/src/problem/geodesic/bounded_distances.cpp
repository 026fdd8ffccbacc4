// SPDX-License-Identifier: BSD-3-Clause
#include "problem/geodesic/bounded_distances.h"

#include <algorithm>
#include <limits>
#include <vector>

#include "problem/geodesic/march.h"
#include "problem/geodesic/source_rows.h"

namespace flbc {
namespace {

using distance::EikonalMesh;
using distance::March;

constexpr std::size_t kWholeSources = 4;
constexpr float kEverywhere = std::numeric_limits<float>::infinity();

// Lets a march run until all of some vertices have been passed, and a little farther, because what
// was passed last may still be improved.
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

  // How far everything is known, after the march.
  float reach() const { return has_stopped_ ? farthest_ : kEverywhere; }

 private:
  const float margin_;
  std::vector<Index> wanted_by_;
  Index source_ = -1;
  Index num_left_ = 0;
  float farthest_ = 0;
  bool has_stopped_ = false;
};

// Some distances that are measured everywhere.
struct Whole {
  std::vector<Index> sources;  // numbers of the sources
  DistanceMatrix distances;    // a column for each
};

// Those from one source, from the source that is the farthest from it, from the one that is the
// farthest from both, and so on.
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
BoundedDistances bounded_distances(const DomainMesh<Dim>& mesh, const MeshTopology<Dim>& topology,
                                   const std::vector<Index>& sources,
                                   const VertexItems<Index>& needed) {
  const EikonalMesh<Dim> eikonal(mesh, topology);
  const auto num_sources = static_cast<Index>(sources.size());
  const Eigen::Matrix<float, Dim, Eigen::Dynamic> points = mesh.points.template cast<float>();
  const auto whole = measure_everywhere(eikonal, sources);
  BoundedDistances result{{}, Eigen::VectorXf::Zero(num_sources)};
  for (const Index i : whole.sources) result.reach[i] = kEverywhere;
  result.distances = distance::by_source_rows(num_sources, mesh.num_vertices(), [&] {
    return [&, march = March<Dim>(eikonal),
            until = UntilPassed(mesh.num_vertices(), eikonal.mean_length)](
               Index i, distance::SourceRows& rows, Index row) mutable {
      if (result.reach[i] == kEverywhere) return;  // its row comes below
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

#define FLBC_INSTANTIATE(Dim)                                                                   \
  template BoundedDistances bounded_distances(const DomainMesh<Dim>&, const MeshTopology<Dim>&, \
                                              const std::vector<Index>&,                        \
                                              const VertexItems<Index>&);
FLBC_INSTANTIATE(2)
FLBC_INSTANTIATE(3)
#undef FLBC_INSTANTIATE

}  // namespace flbc
