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
std::vector<double> round_to_floats(const std::vector<double>& weights) {
  std::vector<double> numbers(weights.size());
  std::transform(weights.begin(), weights.end(), numbers.begin(),
                 [](double weight) { return static_cast<float>(weight); });
  const double others = std::accumulate(numbers.begin() + 1, numbers.end(), 0.0);
  numbers[0] = static_cast<float>(1 - others);
  return numbers;
}

// The remainder goes to the weights that lost most by rounding.
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

std::vector<double> numbers_of(const std::vector<Influence>& influences, WeightFormat format) {
  std::vector<double> exact(influences.size());
  std::transform(influences.begin(), influences.end(), exact.begin(),
                 [](const Influence& influence) { return influence.weight; });
  return format == WeightFormat::kFloat ? round_to_floats(exact)
                                        : round_to_integers(exact, unit_of(format));
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

JointWeights to_joint_weights(const SparseWeights& weights, WeightFormat format) {
  std::vector<std::vector<Influence>> points(weights.num_points());
  std::size_t most = 0;
  for (Index v = 0; v < weights.num_points(); ++v) {
    points[v] = influences_by_weight(weights, v);
    most = std::max(most, points[v].size());
  }
  const auto slots = (static_cast<Index>(most) + kSlotsPerSet - 1) / kSlotsPerSet * kSlotsPerSet;
  JointWeights result;
  result.format = format;
  result.joints.setZero(slots, weights.num_points());
  result.numbers.setZero(slots, weights.num_points());
  for (Index v = 0; v < weights.num_points(); ++v) {
    const auto& influences = points[v];
    const auto numbers = numbers_of(influences, format);
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
      weights[stored.joints(slot, v)] += stored.numbers(slot, v) / unit_of(stored.format);
    }
    return weights;
  });
}

}  // namespace flbc::gltf
