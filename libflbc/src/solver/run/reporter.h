// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Reports progress of a solve to the observer.
#pragma once

#include <cmath>
#include <limits>

#include "base/stage_progress.h"
#include "base/stopwatch.h"
#include "flbc/options.h"

namespace flbc {

//! Maps the progress of a part of the solve to the callbacks of the caller. Keeps a reference.
class Reporter {
 public:
  explicit Reporter(const Observer& observer) : observer_(observer) {}

  //! The same for a mesh that is followed by the given number of finer meshes.
  Reporter with_more_to_come(int levels) const {
    auto other = *this;
    other.finer_levels_ += levels;
    return other;
  }

  //! The same with a time limit from now on.
  Reporter with_limit(double seconds) const {
    auto other = *this;
    other.limit_ = seconds;
    other.watch_ = {};
    return other;
  }

  //! Whether there is a time limit, which is to be checked after every iteration.
  bool has_limit() const { return std::isfinite(limit_); }
  bool is_late() const { return has_limit() && watch_.seconds() >= limit_; }

  //! \return whether the run continues
  bool progress(Progress progress) const {
    progress.finer_levels += finer_levels_;
    return !observer_.progress || observer_.progress(progress);
  }
  bool listens() const { return bool(observer_.progress); }

  //! Lets the observer cancel the solve by an exception.
  void poll() const {
    if (observer_.poll) observer_.poll();
  }

  //! The callback of a stage, for its loops (StageScope).
  StageCallback stage(Stage stage) const {
    if (!observer_.stage && !observer_.poll) return {};
    return [stage, reporter = *this](double done) {
      reporter.poll();
      if (reporter.observer_.stage) reporter.observer_.stage(stage, done);
    };
  }

 private:
  const Observer& observer_;
  int finer_levels_ = 0;
  double limit_ = std::numeric_limits<double>::infinity();  // seconds
  Stopwatch watch_;
};

}  // namespace flbc
