// SPDX-License-Identifier: BSD-3-Clause
#include "solve/progress_estimate.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace flbc::app {
namespace {

constexpr std::size_t kColumns = 79;  // a terminal's 80 would break the line

// "8 s", "2 min 5 s"
std::string duration(double seconds) {
  const auto whole = static_cast<long>(std::ceil(std::clamp(seconds, 0.0, 1e7)));
  if (whole < 60) return std::to_string(whole) + " s";
  return std::to_string(whole / 60) + " min " + std::to_string(whole % 60) + " s";
}

std::string two_digits(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.2g", value);
  return text;
}

// "[########............] 40 %, 8 s left". \param seconds  that the part done took
std::string bar(double done, double seconds) {
  constexpr int kWidth = 20;
  const int filled = std::min(kWidth, static_cast<int>(done * kWidth));
  std::string text = "[" + std::string(filled, '#') + std::string(kWidth - filled, '.') + "] " +
                     std::to_string(static_cast<int>(100 * done)) + "%";
  constexpr double kEnough = 0.03;
  if (done > kEnough && seconds > 0) text += ", " + duration(seconds / done * (1 - done)) + " left";
  return text;
}

// The part of all work that the meshes before this one make up: each has about a third of the
// unknowns of the next.
double share_before(int finer_levels, int levels) {
  double before = 0, all = 0;
  for (int level = 0; level < levels; ++level) {
    const double work = std::pow(3.0, -level);
    all += work;
    if (level > finer_levels) before += work;
  }
  return before / all;
}

}  // namespace

ProgressEstimate::ProgressEstimate(const SolverOptions& options) {
  const auto resolved = resolve(options);
  const bool estimates =
      resolved.method == Method::kWeights || resolved.method == Method::kGradient;
  if (estimates) tolerance_ = *resolved.tolerance;
}

void ProgressEstimate::update(const Progress& progress, double seconds) {
  stage_.clear();
  const double excess =
      std::log(std::max({progress.relative_primal_residual, progress.relative_dual_residual, 1.0}));
  const bool is_new = !started_ || progress.finer_levels != last_.finer_levels;
  if (is_new) first_excess_ = std::max(excess, 1e-9);
  if (!started_) {
    levels_ = progress.finer_levels + 1;
    first_seconds_ = seconds;
  } else {
    interval_ = std::max(interval_, seconds - last_seconds_);
  }
  started_ = true;
  last_ = progress;
  last_.objective = {};
  last_seconds_ = seconds;
  const double begin = share_before(progress.finer_levels, levels_);
  const double end = share_before(progress.finer_levels - 1, levels_);
  const double done = begin + (end - begin) * std::clamp(1 - excess / first_excess_, 0.0, 1.0);
  done_ = std::max(done_, done);
}

void ProgressEstimate::update_stage(const std::string& name, double done, double seconds) {
  if (name != stage_) {
    stage_ = name;
    stage_begin_ = seconds;
    stage_done_ = 0;
  }
  stage_done_ = std::max(stage_done_, std::clamp(done, 0.0, 1.0));
}

std::string ProgressEstimate::stage_line(double seconds) const {
  if (stage_done_ == 1) return (stage_ + ", " + duration(seconds)).substr(0, kColumns);
  return (stage_ + " " + bar(stage_done_, seconds - stage_begin_)).substr(0, kColumns);
}

std::string ProgressEstimate::line(const std::string& stage, double seconds) const {
  if (!stage_.empty()) return stage_line(seconds);
  if (!started_) return (stage + ", " + duration(seconds)).substr(0, kColumns);
  // No callback reports the end: projection and certificate follow.
  if (seconds - last_seconds_ > 1 + 4 * interval_) {
    return "finishing (non-negative weights, certificate, quality), " + duration(seconds);
  }
  std::string text = "solving " + bar(done_, last_seconds_ - first_seconds_);
  text += ", iteration " + std::to_string(last_.iteration);
  const double residual = std::max(last_.relative_primal_residual, last_.relative_dual_residual);
  text += tolerance_ > 0 ? ", error " + two_digits(last_.relative_primal_residual * tolerance_)
                         : ", residual " + two_digits(residual);
  return text.substr(0, kColumns);
}

}  // namespace flbc::app
