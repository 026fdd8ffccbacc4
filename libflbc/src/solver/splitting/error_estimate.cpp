// SPDX-License-Identifier: BSD-3-Clause
#include "solver/splitting/error_estimate.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "base/parallel.h"

namespace flbc::splitting {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// As measured, in 2D and in 3D.
struct Constants {
  int early;      // iterations in which rates alone are not trusted
  double part;    // of k^2 changes, up to then; in 2D rates were right on every model
  double safety;  // of what rates tell
};
constexpr Constants constants_of(int dim) {
  return dim == 2 ? Constants{0, 0, 1.25} : Constants{104, 0.4, 1.5};
}

// The least error relative to a single change.
constexpr double kOfChange = 400;

double square(double x) {
  return x * x;
}

template <class Scalar>
double squared_difference(const Scalar* a, const Scalar* b, std::size_t count) {
  double sum = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const double difference = static_cast<double>(a[i]) - static_cast<double>(b[i]);
    sum += difference * difference;
  }
  return sum;
}

}  // namespace

template <class Scalar>
WeightHistory<Scalar>::WeightHistory(const std::vector<Index>& vertices, std::size_t stride)
    : stride_(stride) {
  constexpr std::size_t kFewest = 4096;
  const std::size_t every = std::max<std::size_t>(1, vertices.size() / kFewest);
  for (std::size_t k = 0; k < vertices.size(); k += every) sample_.push_back(vertices[k]);
}

template <class Scalar>
double WeightHistory<Scalar>::operator()(int iteration, const ReadRow& read) {
  if (iteration % kStep != 0) return -1;
  auto& kept = kept_[static_cast<std::size_t>(iteration / kStep) % kept_.size()];
  const auto count = static_cast<Index>(sample_.size());
  const bool full = kept.size() > 0;
  if (!full) kept = AlignedArray<Scalar>(sample_.size() * stride_);
  const double sum = parallel_sum(count, 0.0, [&](Index begin, Index end) {
    double part = 0;
    AlignedArray<Scalar> row(stride_);
    for (Index k = begin; k < end; ++k) {
      read(sample_[k], row.data());
      part += squared_difference(row.data(), kept.data() + k * stride_, stride_);
      std::memcpy(kept.data() + k * stride_, row.data(), stride_ * sizeof(Scalar));
    }
    return part;
  });
  return full ? sum / std::max<Index>(1, count) : -1;
}

// Sum of the differences to come, in lengths of the last one, if they go on to shrink at this rate
// per iteration.
double ErrorEstimate::spans_left(double rate) const {
  return rate > 0 ? 1 / std::expm1(rate * span_) : kInfinity;
}

// Decay of the differences' length per iteration, by regression over iterations first .. last.
// Infinite with less than two of them.
double ErrorEstimate::rate(double first, double last) const {
  double count = 0, mean_k = 0, mean_y = 0;
  const auto counts = [&](const Entry& entry) {
    return entry.iteration >= first && entry.iteration <= last;
  };
  for (const auto& entry : entries_) {
    if (!counts(entry)) continue;
    ++count;
    mean_k += entry.iteration;
    mean_y += entry.log_difference;
  }
  if (count < 2) return kInfinity;
  mean_k /= count;
  mean_y /= count;
  double covariance = 0, variance = 0;
  for (const auto& entry : entries_) {
    if (!counts(entry)) continue;
    covariance += (entry.iteration - mean_k) * (entry.log_difference - mean_y);
    variance += (entry.iteration - mean_k) * (entry.iteration - mean_k);
  }
  return -0.5 * covariance / variance;
}

// The remaining error, squared, relative to the last squared difference.
double ErrorEstimate::rest() const {
  constexpr double kLeast = 0.5;
  constexpr double kMost = 30;
  constexpr double kPowerSafety = 0.4;  // the promise allows an error of 3 tolerances
  constexpr double kFarthest = 1.5;     // looked ahead, relative to the iterations so far
  constexpr double kPart = 0.2;         // of the iterations so far
  constexpr double kFall = 0.5;         // least rate to come, relative to the present one, squared
  const double now = entries_.back().iteration;
  const double window = std::max<double>(span_, kPart * now);
  const double present = rate(now - window, now);
  if (present == kInfinity) return kLeast;
  const double farthest = square(kFarthest * now / span_);
  double rate_to_come = present;
  const double before = rate(now - 2 * window, now - window);
  if (present > 0 && present < before && before < kInfinity) {
    rate_to_come *= std::sqrt(std::max(present / before, kFall));
  }
  const double by_rate = std::clamp(constants_of(dim_).safety * square(spans_left(rate_to_come)),
                                    kLeast, std::max(kMost, farthest));
  // Elsewhere iterations since the start do not say how far a run is.
  if (start_ != Start::kCold) return by_rate;
  // Differences that shrink as k^-p have the rate p / k, here in the middle of the window, and
  // leave as much as if it were (p - 1) / k from now on.
  const double power_rate = present - 1 / (now - window / 2);
  return std::max(by_rate, std::min(kPowerSafety * square(spans_left(power_rate)), farthest));
}

// Whether an estimate that would end the run is right, by the residual.
double ErrorEstimate::confirmed(int iteration, double residual) {
  // Weights whose gradients are off by the residual are themselves off by the Poincare constant
  // times that, 0.025 of the squared size on a square, or a few times as much; and by more the
  // longer the residual takes to fade.
  constexpr double kPoincare = 0.06;
  constexpr double kPerIteration = 9e-4;
  constexpr int kFirstMeasured = 48;  // differences still see the start, and are large, until then
  constexpr int kInterval = 32;       // relative to the iterations so far
  if (residual >= 0) {
    const double fading = start_ == Start::kCold ? kPerIteration * iteration : 0;
    hidden_ = std::max(kPoincare, fading) * residual;
    next_measured_ = iteration + iteration / kInterval;
  }
  const bool ends = shown_ <= tolerance_ && iteration >= kFirstMeasured;
  wants_residual_ = ends && (hidden_ < 0 || (hidden_ > tolerance_ && iteration >= next_measured_));
  if (!ends) return shown_;
  constexpr double kUnknown = 2;  // tolerances
  return std::max(shown_, hidden_ < 0 ? kUnknown * tolerance_ : hidden_);
}

// A lower bound by the power of the iterations that the error shrinks as at first, which rates do
// not see; and by changes alone, for runs that speed up again.
double ErrorEstimate::least(int iteration, double change) const {
  const auto constants = constants_of(dim_);
  const bool counts = start_ != Start::kNearby && iteration <= constants.early;
  return std::max(kOfChange, counts ? constants.part * square(iteration) : 0) * change;
}

double ErrorEstimate::operator()(int iteration, double change, double difference, double residual) {
  constexpr double kTiny = 1e-300;
  if (!std::isfinite(change)) return change;
  if (!std::isfinite(residual)) return residual;
  if (difference >= 0) {
    entries_.push_back({iteration, std::log(std::max(difference, kTiny))});
    shown_ = std::max(rest() * difference, least(iteration, change));
  } else if (entries_.empty()) {
    shown_ = (start_ == Start::kCold ? 1 : 2) * kOfChange * change;
  }
  return confirmed(iteration, residual);
}

template class WeightHistory<float>;
template class WeightHistory<double>;

}  // namespace flbc::splitting
