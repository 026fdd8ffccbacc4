// SPDX-License-Identifier: BSD-3-Clause
// Where a node of glTF is.
#pragma once

#include <utility>
#include <vector>

#include <Eigen/Geometry>

namespace flbc::io {

//! The transform of a node relative to its parent.
//! \param node  JSON \throws an exception of the JSON library, or std::out_of_range, if it is damaged
template <class Json>
Eigen::Affine3d transform_of(const Json& node) {
  const auto numbers = [&](const char* name, std::vector<double> usual) {
    return node.value(name, std::move(usual));
  };
  Eigen::Affine3d transform = Eigen::Affine3d::Identity();
  if (const auto given = numbers("matrix", {}); given.size() == 16) {
    transform.matrix() = Eigen::Map<const Eigen::Matrix4d>(given.data());
    return transform;
  }
  const auto turn = numbers("rotation", {0, 0, 0, 1});
  const auto size = numbers("scale", {1, 1, 1});
  const auto shift = numbers("translation", {0, 0, 0});
  transform = Eigen::Translation3d(shift.at(0), shift.at(1), shift.at(2)) *
              Eigen::Quaterniond(turn.at(3), turn.at(0), turn.at(1), turn.at(2)) *
              Eigen::Scaling(size.at(0), size.at(1), size.at(2));
  return transform;
}

}  // namespace flbc::io
