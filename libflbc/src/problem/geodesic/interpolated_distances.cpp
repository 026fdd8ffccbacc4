// SPDX-License-Identifier: BSD-3-Clause
#include "problem/geodesic/interpolated_distances.h"

#include "base/instantiate.h"
#include "base/parallel.h"

namespace flbc {
namespace {

// Coordinates of the sources, contiguous.
template <int Dim>
using Sources = Eigen::Array<float, Eigen::Dynamic, Dim>;

template <int Dim>
Eigen::ArrayXf straight_distances(const Sources<Dim>& sources, const Vector<Dim>& point) {
  const Eigen::Array<float, Dim, 1> place = point.template cast<float>().array();
  Eigen::ArrayXf squared = (sources.col(0) - place[0]).square();
  for (int d = 1; d < Dim; ++d) squared += (sources.col(d) - place[d]).square();
  return squared.sqrt();
}

}  // namespace

template <int Dim>
DistanceMatrix interpolated_distances(const KnownDistances<Dim>& known,
                                      const PointList<Dim>& points,
                                      const std::vector<Location<Dim>>& places) {
  const Sources<Dim> sources = known.sources.transpose().template cast<float>().array();
  DistanceMatrix detours = known.distances;
  parallel_for(known.mesh.num_vertices(), [&](Index v) {
    const auto straight = straight_distances<Dim>(sources, known.mesh.points.col(v));
    detours.col(v).array() = (detours.col(v).array() - straight).max(0.0f);  // rounding
  });
  DistanceMatrix distances(known.sources.cols(), points.cols());
  parallel_for(static_cast<Index>(points.cols()), [&](Index p) {
    distances.col(p) = straight_distances<Dim>(sources, points.col(p));
    for (int k = 0; k <= Dim; ++k) {
      distances.col(p) += static_cast<float>(places[p].coordinates[k]) *
                          detours.col(known.mesh.cells(k, places[p].cell));
    }
  });
  return distances;
}

FLBC_INSTANTIATE_FUNCTION(interpolated_distances)

}  // namespace flbc
