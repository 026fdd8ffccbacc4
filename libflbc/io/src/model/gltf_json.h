// SPDX-License-Identifier: BSD-3-Clause
// What numbers in the JSON of glTF mean.
#pragma once

#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

namespace flbc::io {

//! An index, a count, or a size. Others are refused: to convert them would be undefined behavior.
//! \throws std::out_of_range
inline std::size_t to_whole(double value) {
  constexpr double kEnd = 18446744073709551616.0;  // 2^64
  if (!(value >= 0 && value < kEnd) || value != std::floor(value))
    throw std::out_of_range("not a whole number");
  return static_cast<std::size_t>(value);
}

//! \param json  a number \throws an exception of the JSON library, or std::out_of_range
template <class Json>
std::size_t whole(const Json& json) {
  return to_whole(json.template get<double>());
}
//! `usual` where an object has no such number.
template <class Json>
std::size_t whole(const Json& json, const char* name, std::size_t usual) {
  return json.contains(name) ? whole(json[name]) : usual;
}
//! The numbers of a list, none if an object has no such list.
template <class Json>
std::vector<std::size_t> wholes(const Json& json, const char* name) {
  std::vector<std::size_t> values;
  if (!json.contains(name)) return values;
  for (const auto& value : json[name]) values.push_back(whole(value));
  return values;
}

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
