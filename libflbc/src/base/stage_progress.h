// SPDX-License-Identifier: BSD-3-Clause
// Reports progress from inner loops to the caller.
#pragma once

#include <omp.h>

#include <atomic>
#include <exception>
#include <functional>
#include <utility>

#include "flbc/types.h"

namespace flbc {

//! Receives the progress of a stage in [0, 1]; may be empty. What it throws leaves the stage.
using StageCallback = std::function<void(double done)>;

//! During its lifetime, loops on this thread report progress to `callback`; afterwards, the
//! previous callback is restored.
class StageScope {
 public:
  explicit StageScope(StageCallback callback)
      : callback_(std::move(callback)), before_(std::exchange(present_, &callback_)) {}
  ~StageScope() { present_ = before_; }
  StageScope(const StageScope&) = delete;
  StageScope& operator=(const StageScope&) = delete;

  //! \return null or a callback, which may be empty
  static const StageCallback* present() { return present_; }

 private:
  inline static thread_local const StageCallback* present_ = nullptr;
  StageCallback callback_;
  const StageCallback* before_;
};

//! During its lifetime, progress is mapped to the part [begin, end] of the enclosing stage.
class StagePart : public StageScope {
 public:
  StagePart(double begin, double end) : StageScope(mapped(begin, end)) {}

 private:
  static StageCallback mapped(double begin, double end) {
    const StageCallback* const outer = present();
    if (!outer || !*outer) return {};
    return [outer, begin, end](double done) { (*outer)(begin + (end - begin) * done); };
  }
};

//! Counts the iterations of a loop shared by several threads. Only the thread that created it
//! reports progress.
class LoopProgress {
 public:
  //! \param rounds  number of loop iterations, > 0
  explicit LoopProgress(Index rounds) : callback_(StageScope::present()), rounds_(rounds) {}
  // Other threads may have finished the loop. A loop that ends by an exception is not done.
  ~LoopProgress() noexcept(false) {
    if (callback_ && *callback_ && std::uncaught_exceptions() == exceptions_) (*callback_)(1);
  }
  LoopProgress(const LoopProgress&) = delete;
  LoopProgress& operator=(const LoopProgress&) = delete;

  //! Called by any thread of the team after a number of iterations.
  void add(Index rounds) {
    if (!callback_ || !*callback_) return;
    const Index done = done_ += rounds;
    if (omp_get_thread_num() == 0) (*callback_)(static_cast<double>(done) / rounds_);
  }

 private:
  const StageCallback* callback_;
  Index rounds_;
  int exceptions_ = std::uncaught_exceptions();
  std::atomic<Index> done_{0};
};

}  // namespace flbc
