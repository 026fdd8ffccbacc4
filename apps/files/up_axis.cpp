// SPDX-License-Identifier: BSD-3-Clause
#include "files/up_axis.h"

#include <Eigen/Geometry>

#include "flbc/errors.h"

namespace flbc::app {
namespace {

bool stands(const PointList<3>& points, int axis) {
  constexpr double kLowest = 0.03, kLeastShare = 0.1;
  const Eigen::AlignedBox3d all(points.rowwise().minCoeff(), points.rowwise().maxCoeff());
  const double top = all.min()(axis) + kLowest * all.sizes()(axis);
  Eigen::AlignedBox3d feet;
  for (const auto& point : points.colwise()) {
    if (point(axis) <= top) feet.extend(Vector<3>(point));
  }
  Vector<3> center = points.rowwise().mean();
  center(axis) = feet.min()(axis);
  Vector<3> share = feet.sizes().cwiseQuotient(all.sizes());
  share(axis) = 1;
  return feet.contains(center) && share.prod() >= kLeastShare;
}

}  // namespace

int up_axis(UpAxis up, const PointList<3>& points) {
  if (up != UpAxis::kAuto) return static_cast<int>(up);
  for (const int axis : {1, 2, 0}) {
    if (stands(points, axis)) return axis;
  }
  return 1;
}

int up_axis(UpAxis up, const PointList<2>&) {
  if (up != UpAxis::kAuto && up != UpAxis::kY) throw OptionError("--up is for models in 3D");
  return 1;
}

Eigen::Matrix3d turn_upright(int axis) {
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
  if (axis == 0) turn << 0, -1, 0, 1, 0, 0, 0, 0, 1;
  if (axis == 2) turn << 1, 0, 0, 0, 0, 1, 0, -1, 0;
  return turn;
}

}  // namespace flbc::app
