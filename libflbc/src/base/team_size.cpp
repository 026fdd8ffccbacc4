// SPDX-License-Identifier: BSD-3-Clause
#include "base/team_size.h"

#include <omp.h>

#ifdef __linux__
#include <sys/resource.h>
#endif

#include <algorithm>

#include "base/stopwatch.h"

namespace flbc {
namespace {

// Elsewhere no thread is ever seen to lose its core.
CoreUse core_use(double seconds) {
  CoreUse use{seconds, seconds, 0};
#ifdef __linux__
  rusage of{};
  if (getrusage(RUSAGE_THREAD, &of) == 0) {
    const auto in_seconds = [](const timeval& time) {
      return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
    };
    use.on_core = in_seconds(of.ru_utime) + in_seconds(of.ru_stime);
    use.preemptions = of.ru_nivcsw;
  }
#endif
  return use;
}

}  // namespace

void TeamSize::note(const CoreUse& use, int most) {
  constexpr double kAlone = 0.85;  // of the time
  constexpr int kLongestPause = 64;
  // A thread that waits for others or for a file leaves its core, but is not preempted.
  const bool shares_core =
      use.on_core - before_.on_core < kAlone * (use.seconds - before_.seconds) &&
      use.preemptions > before_.preemptions;
  before_ = use;
  if (shares_core && of(most) > 1) {
    ++halvings_;
    pause_ = next_pause_;
    next_pause_ = std::min(2 * next_pause_, kLongestPause);
  } else if (pause_ > 0) {
    --pause_;
  } else if (halvings_ > 0) {
    --halvings_;
  } else {
    next_pause_ = kShortestPause;
  }
}

int team_size() {
  constexpr double kWindow = 0.01;  // seconds; a few time slices of a core
  thread_local TeamSize size;
  thread_local const Stopwatch watch;
  thread_local double noted = 0;
  if (omp_in_parallel()) return 1;
  const int most = omp_get_max_threads();
  if (most == 1) return 1;
  const double now = watch.seconds();
  if (now - noted >= kWindow) {
    noted = now;
    size.note(core_use(now), most);
  }
  return size.of(most);
}

}  // namespace flbc
