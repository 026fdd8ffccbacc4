// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Who is told how far a solve is.
#pragma once

#include "base/stage_progress.h"
#include "flbc/observer.h"

namespace flbc {

//! The caller's callbacks, as a part of the whole solve calls them. Keeps a reference.
class Reporter {
 public:
  explicit Reporter(const Observer& observer) : observer_(observer) {}

  //! The same for a mesh after which so many finer ones, or other parts, are still to come.
  Reporter with_more_to_come(int levels) const {
    auto other = *this;
    other.finer_levels_ += levels;
    return other;
  }
  //! The same for a part of every stage: from `before` on, `share` of it.
  Reporter of_part(double before, double share) const {
    auto other = *this;
    other.before_ = before;
    other.share_ = share;
    return other;
  }

  //! \return whether the run goes on
  bool progress(Progress progress) const {
    progress.finer_levels += finer_levels_;
    return !observer_.progress || observer_.progress(progress);
  }
  bool listens() const { return bool(observer_.progress); }

  //! The callback of a stage, for its loops (StageScope).
  TellPart stage(Stage stage) const {
    if (!observer_.stage) return {};
    return [stage, reporter = *this](double done) {
      reporter.observer_.stage(stage, reporter.before_ + reporter.share_ * done);
    };
  }

 private:
  const Observer& observer_;
  int finer_levels_ = 0;
  double before_ = 0, share_ = 1;
};

}  // namespace flbc
