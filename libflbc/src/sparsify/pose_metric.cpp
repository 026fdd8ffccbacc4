// SPDX-License-Identifier: BSD-3-Clause
#include "sparsify/pose_metric.h"

#include "polytope/scaling.h"

namespace flbc {
namespace {

// Weight of the expectation beside given poses.
constexpr double kGeneral = 0.1;

// The sum of the expectations over all poses of both kinds, each of which displaces by about a
// tenth of the size. In an independent pose the displacements u_i of the control points have no
// correlation, so that |sum d_i u_i|^2 is |d|^2 on average. In a smooth one the displacement at
// place p is A p + (p . B_k p)_k, all entries uniform in [-1, 1], of variance 1/3. The average is a
// sum over products of places, and their products of degree two.
template <int Dim>
Eigen::MatrixXd expectation(const PointList<Dim>& control_points, double size) {
  const PointList<Dim> places =
      2 / size * (control_points.colwise() - control_points.rowwise().mean());
  const Eigen::MatrixXd products = places.transpose().lazyProduct(places);
  Eigen::MatrixXd metric = Dim / 3.0 * (products + products.cwiseProduct(products));
  metric.diagonal().array() += 1;
  return metric;
}

}  // namespace

template <int Dim>
Eigen::MatrixXd pose_metric(const PointList<Dim>& control_points,
                            const std::vector<PointList<Dim>>& poses) {
  const double size = scale_of<Dim>(control_points);
  Eigen::MatrixXd metric = expectation<Dim>(control_points, size);
  if (poses.empty()) return metric;
  metric *= kGeneral;
  for (const auto& pose : poses) {
    // Where a pose is does not matter, as sum d = 0, but would cost digits.
    const PointList<Dim> places = 10 / size * (pose.colwise() - pose.rowwise().mean());
    metric += places.transpose().lazyProduct(places) / static_cast<double>(poses.size());
  }
  return metric;
}

template Eigen::MatrixXd pose_metric(const PointList<2>&, const std::vector<PointList<2>>&);
template Eigen::MatrixXd pose_metric(const PointList<3>&, const std::vector<PointList<3>>&);

}  // namespace flbc
