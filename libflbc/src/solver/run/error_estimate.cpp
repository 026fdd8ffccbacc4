// SPDX-License-Identifier: BSD-3-Clause
#include "solver/run/error_estimate.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "base/parallel.h"
#include "solver/plan/constants.h"

namespace flbc {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

double square(double x) {
  return x * x;
}

}  // namespace

WeightHistory::WeightHistory(const std::vector<Index>& vertices, Index n, bool in_double)
    : n_(static_cast<std::size_t>(n)), in_double_(in_double) {
  const std::size_t every = std::max<std::size_t>(1, vertices.size() / plan::kFewestSampled);
  for (std::size_t k = 0; k < vertices.size(); k += every) sample_.push_back(vertices[k]);
}

template <class Scalar>
std::vector<double> WeightHistory::compare(std::vector<Scalar>& kept, const ReadRow& read) const {
  const auto count = static_cast<Index>(sample_.size());
  const bool full = !kept.empty();
  kept.resize(sample_.size() * n_);
  const auto n = static_cast<Eigen::Index>(n_);
  const Eigen::ArrayXd none = Eigen::ArrayXd::Zero(n);
  const Eigen::ArrayXd sum = parallel_sum(count, none, [&](Index begin, Index end) {
    Eigen::ArrayXd part = none;
    std::vector<double> row(n_);
    for (Index k = begin; k < end; ++k) {
      read(sample_[k], row.data());
      for (std::size_t i = 0; i < n_; ++i) {
        Scalar& before = kept[k * n_ + i];
        const double difference = row[i] - static_cast<double>(before);
        part[static_cast<Eigen::Index>(i)] += difference * difference;
        before = static_cast<Scalar>(row[i]);
      }
    }
    return part;
  });
  if (!full) return {};
  const Eigen::ArrayXd mean = sum / std::max<Index>(1, count);
  return {mean.begin(), mean.end()};
}

std::vector<double> WeightHistory::operator()(int iteration, const ReadRow& read) {
  if (iteration % kStep != 0) return {};
  const auto turn = static_cast<std::size_t>(iteration / kStep) % doubles_.size();
  return in_double_ ? compare(doubles_[turn], read) : compare(floats_[turn], read);
}

// Sum of future differences relative to the last one, if they keep shrinking at this rate per
// iteration.
double ErrorEstimate::spans_left(double rate) const {
  return rate > 0 ? 1 / std::expm1(rate * span_) : kInfinity;
}

// Decay rate of difference norms of a control point, or of all, per iteration, by regression over
// iterations first .. last. Infinite with fewer than two differences.
double ErrorEstimate::rate(std::size_t i, double first, double last) const {
  double count = 0, mean_k = 0, mean_y = 0;
  const auto counts = [&](const Entry& entry) {
    return entry.iteration >= first && entry.iteration <= last;
  };
  for (const auto& entry : entries_) {
    if (!counts(entry)) continue;
    ++count;
    mean_k += entry.iteration;
    mean_y += entry.log_differences[i];
  }
  if (count < 2) return kInfinity;
  mean_k /= count;
  mean_y /= count;
  double covariance = 0, variance = 0;
  for (const auto& entry : entries_) {
    if (!counts(entry)) continue;
    covariance += (entry.iteration - mean_k) * (entry.log_differences[i] - mean_y);
    variance += (entry.iteration - mean_k) * (entry.iteration - mean_k);
  }
  return -0.5 * covariance / variance;
}

// The remaining error of a control point, or of all, squared, relative to the last squared
// difference.
double ErrorEstimate::rest(std::size_t i) const {
  using namespace plan::error_estimate;
  const double now = entries_.back().iteration;
  const double window = std::max<double>(span_, kPart * now);
  const double present = rate(i, now - window, now);
  if (present == kInfinity) return kLeast;
  const double farthest = square(kFarthest * now / span_);
  double rate_to_come = present;
  const double before = rate(i, now - 2 * window, now - window);
  if (present > 0 && present < before && before < kInfinity) {
    rate_to_come *= std::sqrt(std::max(present / before, kFall));
  }
  const double by_rate = std::clamp(early(dim_).safety * square(spans_left(rate_to_come)), kLeast,
                                    std::max(kMost, farthest));
  // For other starts, the number of iterations does not indicate progress.
  if (origin_ != Origin::kCold) return by_rate;
  // Differences that shrink as k^-p have the rate p / k, here in the middle of the window, and
  // leave as much as if it were (p - 1) / k from now on.
  const double power_rate = present - 1 / (now - window / 2);
  return std::max(by_rate, std::min(kPowerSafety * square(spans_left(power_rate)), farthest));
}

// Whether the residual confirms an estimate that would end the run.
double ErrorEstimate::confirmed(int iteration, double residual) {
  using namespace plan::error_estimate;
  const bool cold = origin_ == Origin::kCold;
  if (residual >= 0) {
    hidden_ = std::max(kPoincare, cold ? kPerIteration * iteration : 0) * residual;
    next_measured_ = iteration + iteration / kInterval;
  }
  // The weights of a cold start may still be about to move.
  const double safety = cold && iteration < early_ ? kEarlySafety : 1;
  const bool ends = safety * shown_ <= tolerance_ && (cold || iteration >= kFirstMeasured);
  wants_residual_ = ends && (hidden_ < 0 || (hidden_ > tolerance_ && iteration >= next_measured_));
  const double unknown = plan::kUnknownError * tolerance_;
  if (!ends) return safety > 1 ? std::max(shown_, unknown) : shown_;
  return std::max(shown_, hidden_ < 0 ? unknown : hidden_);
}

// The sum of the squared errors of all control points, from their last differences and the sum of
// these.
double ErrorEstimate::extrapolated(const std::vector<double>& differences, double sum) const {
  using namespace plan::error_estimate;
  double of_each = 0;
  for (std::size_t i = 0; i < differences.size(); ++i) of_each += rest(i) * differences[i];
  const double of_all = rest(differences.size()) * sum;
  const double mean = std::pow(of_each, kShareOfEach) * std::pow(of_all, 1 - kShareOfEach);
  if (origin_ != Origin::kCold) return mean;
  // Weights that creep as 1/k have k / span times their last difference before them.
  return std::max(mean, kCreepSafety * square(entries_.back().iteration / double(span_)) * sum);
}

// A lower bound from the initial power-law decay, which rates do not capture, and from single
// changes, for runs that accelerate again.
double ErrorEstimate::least(int iteration, double change) const {
  const auto early = plan::error_estimate::early(dim_);
  const bool counts = origin_ != Origin::kNearby && iteration <= early.iterations;
  return std::max(plan::error_estimate::kOfChange, counts ? early.part * square(iteration) : 0) *
         change;
}

double ErrorEstimate::operator()(int iteration, double change,
                                 const std::vector<double>& differences, double residual) {
  constexpr double kTiny = 1e-300;
  if (!std::isfinite(change)) return change;
  if (!std::isfinite(residual)) return residual;
  if (!differences.empty()) {
    // Other differences than before, because another iteration has taken over.
    if (!entries_.empty() && entries_.back().log_differences.size() != differences.size() + 1) {
      entries_.clear();
    }
    auto& logs = entries_.emplace_back(Entry{iteration, {}}).log_differences;
    for (const double difference : differences)
      logs.push_back(std::log(std::max(difference, kTiny)));
    const double sum = std::accumulate(differences.begin(), differences.end(), 0.0);
    logs.push_back(std::log(std::max(sum, kTiny)));
    shown_ = std::max(extrapolated(differences, sum) / static_cast<double>(differences.size()),
                      least(iteration, change));
  } else if (entries_.empty()) {
    shown_ = (origin_ == Origin::kCold ? 1 : 2) * plan::error_estimate::kOfChange * change;
  }
  return confirmed(iteration, residual);
}

}  // namespace flbc
