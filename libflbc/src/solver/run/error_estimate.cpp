// SPDX-License-Identifier: BSD-3-Clause
#include "solver/run/error_estimate.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/parallel.h"
#include "solver/plan/constants.h"

namespace flbc {
namespace {

double square(double x) {
  return x * x;
}

// The remaining squared error if the speed keeps shrinking at the same rate. Time is the logarithm
// of the number of iterations. \param made_before  iterations before the start
double extrapolated(const Movement& movement, int made_before) {
  using namespace plan::error_estimate;
  if (movement.last == 0) return 0;
  const auto duration = [&](int from, int to) {
    return std::log(double(made_before + to) / std::max(1, made_before + from));
  };
  const double before = duration(movement.from, movement.middle);
  const double last = duration(movement.middle, movement.to);
  const double slowdown = std::sqrt(movement.before / movement.last) * last / before;
  const double rate = std::log(slowdown) / ((before + last) / 2);
  const double shrinks = std::min(std::exp(-rate * last), kLeastProgress);
  return kSafety * movement.last * square(shrinks / (1 - shrinks));
}

}  // namespace

WeightHistory::WeightHistory(const std::vector<Index>& vertices, Index n, bool in_double, int step)
    : n_(static_cast<std::size_t>(n)), in_double_(in_double), step_(step) {
  const std::size_t every = std::max<std::size_t>(1, vertices.size() / plan::kFewestSampled);
  for (std::size_t k = 0; k < vertices.size(); k += every) sample_.push_back(vertices[k]);
}

// Reads the present weights. \return their mean squared differences to the oldest kept ones and to
// the start, 0 where there are none
template <class Scalar>
Eigen::Array2d WeightHistory::compare(std::vector<Scalar> Kept::*rows, const ReadRow& read) {
  const auto count = static_cast<Index>(sample_.size());
  const bool is_first = kept_.empty();
  const auto& present = present_.*rows;
  const auto& kept = is_first ? present : kept_.front().*rows;
  const auto& start = is_first ? present : start_.*rows;
  (present_.*rows).resize(sample_.size() * n_);
  const Eigen::Array2d none = Eigen::Array2d::Zero();
  const Eigen::Array2d sum = parallel_sum(count, none, [&](Index begin, Index end) {
    Eigen::Array2d part = none;
    std::vector<double> row(n_);
    for (Index k = begin; k < end; ++k) {
      read(sample_[k], row.data());
      for (std::size_t i = 0, at = k * n_; i < n_; ++i, ++at) {
        (present_.*rows)[at] = static_cast<Scalar>(row[i]);
        part[0] += square(row[i] - static_cast<double>(kept[at]));
        part[1] += square(row[i] - static_cast<double>(start[at]));
      }
    }
    return part;
  });
  return sum / std::max(1.0, static_cast<double>(present.size()));
}

std::optional<Movement> WeightHistory::operator()(int iteration, const ReadRow& read) {
  using namespace plan::error_estimate;
  if (iteration % step_ != 0) return {};
  Kept spare;
  while (kept_.size() > 1 && kept_[1].iteration <= kLag * iteration) {
    spare = std::move(kept_.front());
    kept_.pop_front();
  }
  const auto differences =
      in_double_ ? compare(&Kept::doubles, read) : compare(&Kept::floats, read);
  present_.iteration = iteration;
  present_.difference = differences[0];
  if (kept_.empty()) {
    start_ = present_;
    kept_.push_back(present_);
    return {};
  }
  const Kept& before = kept_.front();
  present_.compared_with = before.iteration;
  std::optional<Movement> movement;
  if (before.iteration > 0) {
    movement = Movement{before.compared_with, before.iteration, iteration,
                        before.difference,    differences[0],   differences[1]};
  }
  if (iteration >= kKeptGrowth * kept_.back().iteration) {
    kept_.push_back(std::exchange(present_, std::move(spare)));
  }
  return movement;
}

// How many times smaller the estimate must be, because the weights of a cold start may still be
// about to move.
double ErrorEstimate::safety(int iteration, double tolerance) const {
  using namespace plan::error_estimate;
  if (origin_ != Origin::kCold || tolerance > kLooseTolerance) return 1;
  if (looks_ && iteration < plan::kFirstLook) return kEarlySafety;
  const bool rests = moved_ && *moved_ < kFewMoved * tolerance;
  return rests || iteration < kFirstMeasured ? kRestingSafety : 1;
}

// Whether the residual confirms an estimate that would end the run.
double ErrorEstimate::confirmed(int iteration, double tolerance, double residual) {
  using namespace plan::error_estimate;
  const bool cold = origin_ == Origin::kCold;
  if (residual >= 0) {
    hidden_ = std::max(kPoincare, cold ? kPerIteration * iteration : 0) * residual;
    next_measured_ = iteration + iteration / kInterval;
  }
  const double safety = this->safety(iteration, tolerance);
  const bool ends = safety * shown_ <= tolerance && (cold || iteration >= kFirstMeasured);
  wants_residual_ = ends && (hidden_ < 0 || (hidden_ > tolerance && iteration >= next_measured_));
  const double unknown = plan::kUnknownError * tolerance;
  if (!ends) return safety > 1 ? std::max(shown_, unknown) : shown_;
  return std::max(shown_, hidden_ < 0 ? unknown : hidden_);
}

double ErrorEstimate::operator()(int iteration, double tolerance, double change,
                                 const std::optional<Movement>& movement, double residual) {
  using namespace plan::error_estimate;
  if (!std::isfinite(change)) return change;
  if (!std::isfinite(residual)) return residual;
  if (movement) {
    moved_ = movement->since_start;
    shown_ = std::max(extrapolated(*movement, origin_ == Origin::kNearby ? kMadeBefore : 0),
                      kOfChange * change);
  } else if (!moved_) {
    shown_ = (origin_ == Origin::kCold ? 1 : 2) * kOfChange * change;
  }
  return confirmed(iteration, tolerance, residual);
}

}  // namespace flbc
