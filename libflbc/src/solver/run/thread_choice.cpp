// SPDX-License-Identifier: BSD-3-Clause
#include "solver/run/thread_choice.h"

#include <time.h>

#include <algorithm>

namespace flbc {

void ThreadChoice::note(int iterations, double seconds, double on_core) {
  constexpr double kWindow = 0.03;  // seconds; several time slices of a core
  constexpr double kAlone = 0.85;   // of the time; threads that wait for others keep their core
  iterations_ += iterations;
  seconds_ += seconds;
  on_core_ += on_core;
  if (most_ == 1 || seconds_ < kWindow) return;
  judge(seconds_ / iterations_, on_core_ < kAlone * seconds_);
  iterations_ = 0;
  seconds_ = on_core_ = 0;
}

void ThreadChoice::judge(double pace, bool shares_core) {
  constexpr double kFaster = 0.9;
  constexpr int kLongestPause = 64;
  constexpr int kUntilMore = 16;
  if (trial_ > 0) {
    const bool gains = pace < kFaster * pace_;
    if (gains) threads_ = trial_;
    pause_ = gains ? 1 : std::min(2 * pause_, kLongestPause);
    trial_ = windows_ = 0;
    return;
  }
  pace_ = pace;
  ++windows_;
  if (threads_ > 1 && shares_core && windows_ >= pause_) {
    const bool half_gained_nothing = pause_ > 1;
    trial_ = half_gained_nothing ? 1 : threads_ / 2;
  } else if (threads_ < most_ && windows_ >= std::max(pause_, kUntilMore)) {
    trial_ = std::min(2 * threads_, most_);
  }
}

double seconds_on_core() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

}  // namespace flbc
