// SPDX-License-Identifier: BSD-3-Clause
#include "problem/geodesic/interpolated_distances.h"

namespace flbc {
namespace {

template <int Dim>
Eigen::VectorXd straight_distances(const PointList<Dim>& sources, const Vector<Dim>& point) {
  return (sources.colwise() - point).colwise().norm().transpose();
}

}  // namespace

template <int Dim>
Eigen::MatrixXd interpolated_distances(const KnownDistances<Dim>& known,
                                       const PointList<Dim>& points,
                                       const std::vector<Location<Dim>>& places) {
  Eigen::MatrixXd detours = known.distances;
#pragma omp parallel for schedule(static)
  for (Index v = 0; v < known.mesh.num_vertices(); ++v) {
    detours.col(v) -= straight_distances<Dim>(known.sources, known.mesh.points.col(v));
    detours.col(v) = detours.col(v).cwiseMax(0.0);  // rounding
  }
  Eigen::MatrixXd distances(known.sources.cols(), points.cols());
#pragma omp parallel for schedule(static)
  for (Index p = 0; p < static_cast<Index>(points.cols()); ++p) {
    distances.col(p) = straight_distances<Dim>(known.sources, points.col(p));
    for (int k = 0; k <= Dim; ++k) {
      distances.col(p) +=
          places[p].coordinates[k] * detours.col(known.mesh.cells(k, places[p].cell));
    }
  }
  return distances;
}

#define FLBC_INSTANTIATE(Dim)                                                          \
  template Eigen::MatrixXd interpolated_distances(const KnownDistances<Dim>&,          \
                                                  const PointList<Dim>&,               \
                                                  const std::vector<Location<Dim>>&);
FLBC_INSTANTIATE(2)
FLBC_INSTANTIATE(3)
#undef FLBC_INSTANTIATE

}  // namespace flbc
