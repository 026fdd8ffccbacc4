// SPDX-License-Identifier: BSD-3-Clause
#include "front/up_axis.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "flbc/errors.h"
#include "front/gltf_facts.h"

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

UpAxis up_of(UpAxis up, const std::string& model) {
  return up == UpAxis::kAuto && is_gltf_file(model) ? UpAxis::kY : up;
}

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

double front_azimuth(int up, const PointList<3>& points) {
  constexpr double kFeet = 0.04, kAnkles = 0.1, kShins = 0.15, kLeastStep = 0.02;
  if (!stands(points, up)) return 0;
  const PointList<3> upright = turn_upright(up) * points;
  const double low = upright.row(1).minCoeff(), height = upright.row(1).maxCoeff() - low;
  Eigen::AlignedBox3d feet, ankles;
  for (const auto& point : upright.colwise()) {
    const double level = (point.y() - low) / height;
    if (level <= kFeet) feet.extend(Vector<3>(point));
    if (level >= kAnkles && level <= kShins) ankles.extend(Vector<3>(point));
  }
  if (ankles.isEmpty()) return 0;
  const Vector<3> step = (feet.center() - ankles.center()) / height;
  const double x = step.x(), z = step.z();
  if (std::max(std::abs(x), std::abs(z)) < kLeastStep) return 0;
  if (std::abs(x) > std::abs(z)) return x > 0 ? 90 : -90;
  return z > 0 ? 0 : 180;
}

Eigen::Matrix3d turn_upright(int axis) {
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
  if (axis == 0) turn << 0, -1, 0, 1, 0, 0, 0, 0, 1;
  if (axis == 2) turn << 1, 0, 0, 0, 0, 1, 0, -1, 0;
  return turn;
}

}  // namespace flbc::app
