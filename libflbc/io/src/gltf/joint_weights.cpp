// SPDX-License-Identifier: BSD-3-Clause
#include "gltf/joint_weights.h"

#include <algorithm>
#include <vector>

namespace flbc::gltf {
namespace {

// glTF has slots in sets of four.
constexpr Index kSlotsPerSet = 4;

struct Influence {
  Index joint;
  double weight;
};

// Largest first, so readers that support only one set of four get the most important ones.
std::vector<Influence> influences_by_weight(const SparseWeights& weights, Index point) {
  std::vector<Influence> influences;
  weights.visit(point, [&](Index joint, double weight) {
    if (weight > 0) influences.push_back({joint, weight});
  });
  if (influences.empty()) return {{weights.num_control_points(), 1}};
  std::stable_sort(influences.begin(), influences.end(),
                   [](const auto& a, const auto& b) { return a.weight > b.weight; });
  return influences;
}

// The largest weight gets the rounding remainder, so the sum is 1.
std::vector<float> rounded(const std::vector<Influence>& influences) {
  std::vector<float> numbers;
  double others = 0;
  for (const auto& influence : influences) {
    numbers.push_back(static_cast<float>(influence.weight));
    if (numbers.size() > 1) others += numbers.back();
  }
  numbers[0] = static_cast<float>(1 - others);
  return numbers;
}

}  // namespace

JointWeights to_joint_weights(const SparseWeights& weights) {
  std::vector<std::vector<Influence>> points(weights.num_points());
  std::size_t most = 0;
  for (Index v = 0; v < weights.num_points(); ++v) {
    points[v] = influences_by_weight(weights, v);
    most = std::max(most, points[v].size());
  }
  const auto slots = (static_cast<Index>(most) + kSlotsPerSet - 1) / kSlotsPerSet * kSlotsPerSet;
  JointWeights result;
  result.joints.setZero(slots, weights.num_points());
  result.numbers.setZero(slots, weights.num_points());
  for (Index v = 0; v < weights.num_points(); ++v) {
    const auto& influences = points[v];
    const auto numbers = rounded(influences);
    Index slot = 0;
    for (std::size_t k = 0; k < influences.size(); ++k) {
      // A weight that rounds to zero is dropped.
      if (numbers[k] == 0) continue;
      result.joints(slot, v) = static_cast<std::uint16_t>(influences[k].joint);
      result.numbers(slot++, v) = numbers[k];
    }
  }
  return result;
}

SparseWeights to_weights(const JointWeights& stored, Eigen::Index num_joints) {
  const auto num_points = static_cast<Index>(stored.joints.cols());
  return SparseWeights::of(static_cast<Index>(num_joints), num_points, [&](Index v) {
    Eigen::VectorXd weights = Eigen::VectorXd::Zero(num_joints);
    for (Eigen::Index slot = 0; slot < stored.joints.rows(); ++slot) {
      if (stored.joints(slot, v) == num_joints) continue;
      weights[stored.joints(slot, v)] += double{stored.numbers(slot, v)};
    }
    return weights;
  });
}

}  // namespace flbc::gltf
