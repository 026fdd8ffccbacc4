// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/sparse_weights.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "base/parallel.h"
#include "flbc/errors.h"

namespace flbc {
namespace {

[[noreturn]] void refuse(Index point, const char* what) {
  throw InputError("the sparse weights of point " + std::to_string(point) + " " + what);
}

}  // namespace

SparseWeights::SparseWeights(const WeightMatrix& weights, double threshold)
    : num_control_points_(static_cast<Index>(weights.rows())),
      starts_(static_cast<std::size_t>(weights.cols()) + 1, 0) {
  if (!(threshold >= 0)) {
    throw OptionError("the threshold of sparse weights must be 0 or more, not " +
                      std::to_string(threshold));
  }
  const Eigen::Index count = weights.cols();
  parallel_for(count, [&](Eigen::Index p) {
    starts_[p + 1] = weights.rows() - (weights.col(p).array().abs() <= threshold).count();
  });
  for (Eigen::Index p = 0; p < count; ++p) starts_[p + 1] += starts_[p];
  control_points_.resize(starts_.back());
  values_.resize(starts_.back());
  parallel_for(count, [&](Eigen::Index p) {
    std::int64_t entry = starts_[p];
    for (Eigen::Index i = 0; i < weights.rows(); ++i) {
      if (std::abs(weights(i, p)) <= threshold) continue;  // keeps NaN
      control_points_[entry] = static_cast<std::uint32_t>(i);
      values_[entry++] = weights(i, p);
    }
  });
}

SparseWeights::SparseWeights(Index num_control_points, std::vector<std::int64_t> starts,
                             std::vector<std::uint32_t> control_points, std::vector<double> values)
    : num_control_points_(num_control_points),
      starts_(std::move(starts)),
      control_points_(std::move(control_points)),
      values_(std::move(values)) {
  const auto count = static_cast<std::int64_t>(values_.size());
  if (num_control_points < 0 || starts_.empty() || starts_.front() != 0 ||
      starts_.back() != count || control_points_.size() != values_.size()) {
    throw InputError("sparse weights need as many control points as values, and starts from 0 to " +
                     std::to_string(count));
  }
  for (Index p = 0; p < num_points(); ++p) {
    if (starts_[p + 1] < starts_[p] || starts_[p + 1] > count) refuse(p, "end before they start");
    for (std::int64_t k = starts_[p]; k < starts_[p + 1]; ++k) {
      if (control_points_[k] >= static_cast<std::uint32_t>(num_control_points)) {
        refuse(p, "refer to a control point that does not exist");
      }
      if (k > starts_[p] && control_points_[k] <= control_points_[k - 1]) {
        refuse(p, "are not in the order of their control points");
      }
      if (!std::isfinite(values_[k])) refuse(p, "are not finite");
    }
  }
}

SparseWeights SparseWeights::of(Index num_control_points, Index num_points,
                                const std::function<Eigen::VectorXd(Index)>& of_point) {
  // The weights of 64 points; one allocation per point would fragment the memory.
  struct Block {
    std::vector<std::uint32_t> control_points;
    std::vector<double> values;
  };
  constexpr Index kBlock = 64;
  std::vector<Block> blocks((num_points + kBlock - 1) / kBlock);
  const auto num_blocks = static_cast<Index>(blocks.size());
  SparseWeights result;
  result.num_control_points_ = num_control_points;
  result.starts_.resize(static_cast<std::size_t>(num_points) + 1);
  parallel_for_chunks(num_blocks, 1, [&](Index b) {
    auto& [control_points, values] = blocks[b];
    for (Index p = b * kBlock; p < std::min(num_points, (b + 1) * kBlock); ++p) {
      const Eigen::VectorXd weights = of_point(p);
      if (weights.size() != num_control_points) refuse(p, "are not as many as control points");
      for (Index i = 0; i < num_control_points; ++i) {
        if (weights[i] == 0) continue;
        control_points.push_back(static_cast<std::uint32_t>(i));
        values.push_back(weights[i]);
      }
      result.starts_[p + 1] = static_cast<std::int64_t>(values.size());  // in the block
    }
  });
  std::int64_t before = 0;
  for (Index p = 0; p < num_points; ++p) {
    if (p % kBlock == 0) before = result.starts_[p];
    result.starts_[p + 1] += before;
  }
  result.control_points_.reserve(result.starts_.back());
  result.values_.reserve(result.starts_.back());
  for (auto& [control_points, values] : blocks) {
    result.control_points_.insert(result.control_points_.end(), control_points.begin(),
                                  control_points.end());
    result.values_.insert(result.values_.end(), values.begin(), values.end());
    control_points = {};
    values = {};
  }
  return result;
}

bool SparseWeights::has_weights(Index point) const {
  return std::any_of(values_.begin() + starts_[point], values_.begin() + starts_[point + 1],
                     [](double weight) { return weight != 0; });
}

Eigen::VectorXd SparseWeights::at(Index point) const {
  Eigen::VectorXd weights = Eigen::VectorXd::Zero(num_control_points_);
  visit(point, [&](Index i, double weight) { weights[i] = weight; });
  return weights;
}

Eigen::VectorXd SparseWeights::of_control_point(Index control_point) const {
  Eigen::VectorXd weights = Eigen::VectorXd::Zero(num_points());
  for (Index p = 0; p < num_points(); ++p) {
    visit(p, [&](Index i, double weight) {
      if (i == control_point) weights[p] = weight;
    });
  }
  return weights;
}

WeightMatrix SparseWeights::dense() const {
  WeightMatrix weights(num_control_points_, num_points());
  parallel_for(num_points(), [&](Index p) { weights.col(p) = at(p); });
  return weights;
}

}  // namespace flbc
