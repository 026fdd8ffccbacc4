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
DistanceMatrix interpolated_distances(const PointList<Dim>& sources, const PointList<Dim>& points,
                                      const std::vector<std::array<Index, 2>>& ends,
                                      const DistanceMatrix& distances) {
  const Sources<Dim> from = sources.transpose().template cast<float>().array();
  DistanceMatrix detours = distances;
  parallel_for(static_cast<Index>(detours.cols()), [&](Index v) {
    const auto straight = straight_distances<Dim>(from, points.col(v));
    detours.col(v).array() = (detours.col(v).array() - straight).max(0.0f);  // rounding
  });
  DistanceMatrix all(sources.cols(), points.cols());
  parallel_for(static_cast<Index>(points.cols()), [&](Index v) {
    const auto [a, b] = ends[v];
    all.col(v) = straight_distances<Dim>(from, points.col(v)).matrix() +
                 (detours.col(a) + detours.col(b)) / 2;
  });
  return all;
}

FLBC_INSTANTIATE_FUNCTION(interpolated_distances)

}  // namespace flbc
