// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Processor time, which unlike a clock is the same on a busy machine.
#pragma once

#ifdef _WIN32
#include <ctime>
#else
#include <sys/resource.h>
#endif

namespace flbc::testing {

//! Seconds of this process and, except on Windows, of its children that have ended.
inline double processor_seconds() {
#ifdef _WIN32
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
#else
  double seconds = 0;
  for (const auto who : {RUSAGE_SELF, RUSAGE_CHILDREN}) {
    rusage usage{};
    getrusage(who, &usage);
    for (const auto& time : {usage.ru_utime, usage.ru_stime}) {
      seconds += static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
    }
  }
  return seconds;
#endif
}

}  // namespace flbc::testing
