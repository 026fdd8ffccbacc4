// SPDX-License-Identifier: BSD-3-Clause
#include "poses/moved_by.h"

#include "flbc/bounding_box.h"
#include "flbc/deform.h"
#include "flbc/green.h"

namespace flbc::app {
namespace {

// What weights do not reproduce of the points, Dim x P.
template <int Dim>
PointList<Dim> missing_parts(const SparseWeights& weights, const PointList<Dim>& rest,
                             const PointList<Dim>& points, double tolerance) {
  PointList<Dim> missing = PointList<Dim>::Zero(Dim, points.cols());
  const bool is_known = rest.cols() > 0;
  if (is_known) {
    missing = points - deform<Dim>(weights, rest);
    const double least = tolerance * bounding_box_diagonal(rest);
    for (auto part : missing.colwise()) {
      if (part.norm() <= least) part.setZero();
    }
  }
  for (Index p = 0; p < weights.num_points(); ++p) {
    if (!weights.has_weights(p)) missing.col(p) = points.col(p);
  }
  return missing;
}

}  // namespace

template <int Dim>
PointList<Dim> MovedBy<Dim>::at(const PointList<Dim>& pose) const {
  return deform<Dim>(weights, vectors(pose));
}

template <int Dim>
MovedBy<Dim> by_weights(const SparseWeights& weights, const PointList<Dim>& rest,
                        const PointList<Dim>& points, double tolerance) {
  const auto missing = missing_parts<Dim>(weights, rest, points, tolerance);
  if (missing.isZero(0)) return {weights, [](const PointList<Dim>& pose) { return pose; }};
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

template <int Dim>
MovedBy<Dim> by_green_coordinates(const Cage<Dim>& cage, const PointList<Dim>& points) {
  return {SparseWeights(green_coordinates(cage, points)),
          [cage](const PointList<Dim>& pose) { return control_points_and_normals(cage, pose); }};
}

#define FLBC_INSTANTIATE(Dim)                                                   \
  template struct MovedBy<Dim>;                                                 \
  template MovedBy<Dim> by_weights(const SparseWeights&, const PointList<Dim>&, \
                                   const PointList<Dim>&, double);              \
  template MovedBy<Dim> by_green_coordinates(const Cage<Dim>&, const PointList<Dim>&);
FLBC_INSTANTIATE(2)
FLBC_INSTANTIATE(3)
#undef FLBC_INSTANTIATE

}  // namespace flbc::app
