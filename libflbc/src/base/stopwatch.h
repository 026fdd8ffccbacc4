// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Wall-clock time.
#pragma once

#include <chrono>

namespace flbc {

class Stopwatch {
 public:
  //! Seconds since construction or the last call.
  double lap() {
    const auto now = Clock::now();
    const double seconds = std::chrono::duration<double>(now - start_).count();
    start_ = now;
    return seconds;
  }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point start_ = Clock::now();
};

}  // namespace flbc
