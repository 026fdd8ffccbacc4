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

SparseWeights::SparseWeights(const WeightMatrix& weights, double threshold) {
  if (!(threshold >= 0)) {
    throw OptionError("the threshold of sparse weights must be 0 or more, not " +
                      std::to_string(threshold));
  }
  Entries entries;
  auto& starts = entries.starts;
  const Eigen::Index count = weights.cols();
  starts.resize(static_cast<std::size_t>(count) + 1);
  parallel_for(count, [&](Eigen::Index p) {
    starts[p + 1] = weights.rows() - (weights.col(p).array().abs() <= threshold).count();
  });
  for (Eigen::Index p = 0; p < count; ++p) starts[p + 1] += starts[p];
  entries.control_points.resize(starts.back());
  entries.values.resize(starts.back());
  parallel_for(count, [&](Eigen::Index p) {
    std::int64_t entry = starts[p];
    for (Eigen::Index i = 0; i < weights.rows(); ++i) {
      if (std::abs(weights(i, p)) <= threshold) continue;  // keeps NaN
      entries.control_points[entry] = static_cast<std::uint32_t>(i);
      entries.values[entry++] = weights(i, p);
    }
  });
  *this = SparseWeights(static_cast<Index>(weights.rows()), std::move(entries));
}

SparseWeights::SparseWeights(Index num_control_points, std::vector<std::int64_t> starts,
                             std::vector<std::uint32_t> control_points, std::vector<double> values)
    : SparseWeights(num_control_points,
                    Entries{std::move(starts), std::move(control_points), std::move(values)}) {
  const auto& [first, carriers, weights] = *entries_;
  const auto count = static_cast<std::int64_t>(weights.size());
  if (num_control_points < 0 || first.empty() || first.front() != 0 || first.back() != count ||
      carriers.size() != weights.size()) {
    throw InputError("sparse weights need as many control points as values, and starts from 0 to " +
                     std::to_string(count));
  }
  for (Index p = 0; p < num_points(); ++p) {
    if (first[p + 1] < first[p] || first[p + 1] > count) refuse(p, "end before they start");
    for (std::int64_t k = first[p]; k < first[p + 1]; ++k) {
      if (carriers[k] >= static_cast<std::uint32_t>(num_control_points)) {
        refuse(p, "refer to a control point that does not exist");
      }
      if (k > first[p] && carriers[k] <= carriers[k - 1]) {
        refuse(p, "are not in the order of their control points");
      }
      if (!std::isfinite(weights[k])) refuse(p, "are not finite");
    }
  }
}

SparseWeights SparseWeights::of(Index num_control_points, Index num_points,
                                const std::function<Eigen::VectorXd(Index)>& of_point) {
  // Threads fill blocks of points, and the blocks of a batch are appended to the result.
  struct Block {
    std::vector<std::uint32_t> control_points;
    std::vector<double> values;
  };
  constexpr Index kBlock = 64, kBlocks = 64;
  std::vector<Block> blocks(kBlocks);
  Entries entries;
  entries.starts.resize(static_cast<std::size_t>(num_points) + 1);
  for (Index first = 0; first < num_points; first += kBlocks * kBlock) {
    const Index last = std::min(num_points - first, kBlocks * kBlock) + first;
    const Index num_blocks = (last - first + kBlock - 1) / kBlock;
    parallel_for_chunks(num_blocks, 1, [&](Index b) {
      auto& [control_points, values] = blocks[b];
      control_points.clear();
      values.clear();
      const Index begin = first + b * kBlock;
      for (Index p = begin; p < std::min(last, begin + kBlock); ++p) {
        const Eigen::VectorXd weights = of_point(p);
        if (weights.size() != num_control_points) refuse(p, "are not as many as control points");
        for (Index i = 0; i < num_control_points; ++i) {
          if (weights[i] == 0) continue;
          control_points.push_back(static_cast<std::uint32_t>(i));
          values.push_back(weights[i]);
        }
        entries.starts[p + 1] = static_cast<std::int64_t>(values.size());  // in the block
      }
    });
    std::int64_t before = 0;
    for (Index p = first; p < last; ++p) {
      if (p % kBlock == 0) before = entries.starts[p];
      entries.starts[p + 1] += before;
    }
    if (first == 0) {  // as if all batches were like the first: growth would copy
      const double batches = last < num_points ? 1.1 * num_points / last : 1;
      const auto count =
          static_cast<std::size_t>(batches * static_cast<double>(entries.starts[last]));
      entries.control_points.reserve(count);
      entries.values.reserve(count);
    }
    for (Index b = 0; b < num_blocks; ++b) {
      const auto& [control_points, values] = blocks[b];
      entries.control_points.insert(entries.control_points.end(), control_points.begin(),
                                    control_points.end());
      entries.values.insert(entries.values.end(), values.begin(), values.end());
    }
  }
  return {num_control_points, std::move(entries)};
}

bool SparseWeights::has_weights(Index point) const {
  bool any = false;
  visit(point, [&](Index, double weight) { any = any || weight != 0; });
  return any;
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
