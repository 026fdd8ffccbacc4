// SPDX-License-Identifier: BSD-3-Clause
#include "poses/moved_by.h"

#include "flbc/deform.h"
#include "flbc/green.h"

namespace flbc::app {

template <int Dim>
MovedBy<Dim> by_control_points(SparseWeights weights) {
  return {std::move(weights), [](const PointList<Dim>& pose) { return pose; }};
}

template <int Dim>
MovedBy<Dim> by_green_coordinates(const Cage<Dim>& cage, const PointList<Dim>& points) {
  return {SparseWeights(green_coordinates(cage, points)),
          [cage](const PointList<Dim>& pose) { return control_points_and_normals(cage, pose); }};
}

template <int Dim>
MovedBy<Dim> by_displacements(const SparseWeights& weights, const PointList<Dim>& rest,
                              const PointList<Dim>& points) {
  const PointList<Dim> missing = points - deform<Dim>(weights, rest);
  const auto n = weights.num_control_points();
  auto joined = SparseWeights::of(n + Dim, weights.num_points(), [&](Index p) {
    Eigen::VectorXd column(n + Dim);
    column << weights.at(p), missing.col(p);
    return column;
  });
  return {std::move(joined), [](const PointList<Dim>& pose) {
            PointList<Dim> vectors(Dim, pose.cols() + Dim);
            vectors << pose, Eigen::Matrix<double, Dim, Dim>::Identity();
            return vectors;
          }};
}

#define FLBC_INSTANTIATE(Dim)                                                          \
  template MovedBy<Dim> by_control_points(SparseWeights);                              \
  template MovedBy<Dim> by_green_coordinates(const Cage<Dim>&, const PointList<Dim>&); \
  template MovedBy<Dim> by_displacements(const SparseWeights&, const PointList<Dim>&,  \
                                         const PointList<Dim>&);
FLBC_INSTANTIATE(2)
FLBC_INSTANTIATE(3)
#undef FLBC_INSTANTIATE

}  // namespace flbc::app
