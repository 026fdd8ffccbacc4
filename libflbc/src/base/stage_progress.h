// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! How far a long computation is, told from its loops to whoever asked.
#pragma once

#include <omp.h>

#include <atomic>
#include <functional>
#include <utility>

#include "flbc/types.h"

namespace flbc {

//! Told the part in [0, 1] of a stage that is done; empty for nobody.
using TellPart = std::function<void(double done)>;

//! While it lives, the loops that this thread runs tell `tell` how far they are; before and after,
//! whoever was told before.
class StageScope {
 public:
  explicit StageScope(TellPart tell)
      : tell_(std::move(tell)), before_(std::exchange(present_, &tell_)) {}
  ~StageScope() { present_ = before_; }
  StageScope(const StageScope&) = delete;
  StageScope& operator=(const StageScope&) = delete;

  //! \return null or a callback, which may be empty
  static const TellPart* present() { return present_; }

 private:
  inline static thread_local const TellPart* present_ = nullptr;
  TellPart tell_;
  const TellPart* before_;
};

//! While it lives, what is told is the part [begin, end] of the stage around it.
class StagePart : public StageScope {
 public:
  StagePart(double begin, double end) : StageScope(mapped(begin, end)) {}

 private:
  static TellPart mapped(double begin, double end) {
    const TellPart* const outer = present();
    if (!outer || !*outer) return {};
    return [outer, begin, end](double done) { (*outer)(begin + (end - begin) * done); };
  }
};

//! Counts the rounds of a loop that several threads share. Only the thread that made it tells.
class LoopProgress {
 public:
  //! \param rounds  of the loop, > 0
  explicit LoopProgress(Index rounds) : tell_(StageScope::present()), rounds_(rounds) {}
  ~LoopProgress() {
    if (tell_ && *tell_) (*tell_)(1);  // others may have done the last rounds, or all
  }
  LoopProgress(const LoopProgress&) = delete;
  LoopProgress& operator=(const LoopProgress&) = delete;

  //! To be called by any thread of the team after so many rounds.
  void add(Index rounds) {
    if (!tell_ || !*tell_) return;
    const Index done = done_ += rounds;
    if (omp_get_thread_num() == 0) (*tell_)(static_cast<double>(done) / rounds_);
  }

 private:
  const TellPart* tell_;
  Index rounds_;
  std::atomic<Index> done_{0};
};

}  // namespace flbc
