// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>

namespace flbc::bench {

class Stopwatch {
 public:
  //! Seconds since construction.
  double seconds() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point start_ = Clock::now();
};

}  // namespace flbc::bench
