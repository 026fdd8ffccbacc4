// SPDX-License-Identifier: BSD-3-Clause
#include "gltf/joint_weights.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

namespace flbc::gltf {
namespace {

// glTF has slots in sets of four.
constexpr Index kSlotsPerSet = 4;

// The joints with an influence, the largest first: readers that know one set of four only then
// have those that matter most.
std::vector<Index> joints_by_weight(const WeightMatrix& weights, Eigen::Index point) {
  std::vector<Index> joints;
  for (Index i = 0; i < static_cast<Index>(weights.rows()); ++i) {
    if (weights(i, point) > 0) joints.push_back(i);
  }
  std::stable_sort(joints.begin(), joints.end(),
                   [&](Index a, Index b) { return weights(a, point) > weights(b, point); });
  return joints;
}

// The largest one takes what rounding leaves to 1.
std::vector<double> round_to_floats(const std::vector<double>& weights) {
  std::vector<double> numbers(weights.size());
  std::transform(weights.begin(), weights.end(), numbers.begin(),
                 [](double weight) { return static_cast<float>(weight); });
  const double others = std::accumulate(numbers.begin() + 1, numbers.end(), 0.0);
  numbers[0] = static_cast<float>(1 - others);
  return numbers;
}

// The rest to the unit goes to those that lost most.
std::vector<double> round_to_integers(const std::vector<double>& weights, double unit) {
  std::vector<double> numbers(weights.size());
  std::vector<std::size_t> order(weights.size());
  std::transform(weights.begin(), weights.end(), numbers.begin(),
                 [&](double weight) { return std::floor(weight * unit); });
  const auto remainder = [&](std::size_t k) { return weights[k] * unit - numbers[k]; };
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](auto a, auto b) { return remainder(a) > remainder(b); });
  const double sum = std::accumulate(numbers.begin(), numbers.end(), 0.0);
  const auto missing = static_cast<std::size_t>(unit - sum);
  for (std::size_t k = 0; k < missing; ++k) ++numbers[order[k % order.size()]];
  return numbers;
}

}  // namespace

double unit_of(WeightFormat format) {
  switch (format) {
    case WeightFormat::kUnsignedShort:
      return 65535;
    case WeightFormat::kUnsignedByte:
      return 255;
    default:
      return 1;
  }
}

JointWeights to_joint_weights(const WeightMatrix& weights, WeightFormat format) {
  const double unit = unit_of(format);
  const auto most = (weights.array() > 0).colwise().count().maxCoeff();
  const auto slots = (most + kSlotsPerSet - 1) / kSlotsPerSet * kSlotsPerSet;
  JointWeights result;
  result.format = format;
  result.joints.setZero(slots, weights.cols());
  result.numbers.setZero(slots, weights.cols());
  for (Eigen::Index v = 0; v < weights.cols(); ++v) {
    const auto joints = joints_by_weight(weights, v);
    const Eigen::VectorXd column = weights(joints, v);
    const std::vector<double> exact(column.begin(), column.end());
    const auto numbers =
        format == WeightFormat::kFloat ? round_to_floats(exact) : round_to_integers(exact, unit);
    Index slot = 0;
    for (std::size_t k = 0; k < joints.size(); ++k) {
      // One that rounds to nothing is none.
      if (numbers[k] == 0) continue;
      result.joints(slot, v) = static_cast<std::uint16_t>(joints[k]);
      result.numbers(slot++, v) = numbers[k];
    }
  }
  return result;
}

WeightMatrix to_weights(const JointWeights& stored, Eigen::Index num_joints) {
  WeightMatrix weights = WeightMatrix::Zero(num_joints, stored.joints.cols());
  for (Eigen::Index v = 0; v < weights.cols(); ++v) {
    for (Eigen::Index slot = 0; slot < stored.joints.rows(); ++slot) {
      weights(stored.joints(slot, v), v) += stored.numbers(slot, v) / unit_of(stored.format);
    }
  }
  return weights;
}

}  // namespace flbc::gltf
