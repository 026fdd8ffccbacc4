// SPDX-License-Identifier: BSD-3-Clause
#include "base/team_size.h"

#include <functional>

#include "support/test.h"

namespace flbc {
namespace {

// What loops of a team do with a core in a window of time.
struct Machine {
  std::function<double(int threads)> pace;  // loops a second
  double share;                             // of a core that a thread has
  bool preempts;
};

const Machine kQuiet{[](int threads) { return 1e3 * threads; }, 1, false};
// Threads that wait for one without a core gain nothing.
const Machine kBusy{[](int threads) { return threads == 1 ? 1e3 : 200; }, 0.6, true};
// Threads that sleep while they wait, as OMP_WAIT_POLICY=passive asks for.
const Machine kSleeping{[](int threads) { return 1e3 * threads; }, 0.6, false};

class Thread {
 public:
  explicit Thread(int most) : most_(most) {}

  // \return loops made
  double run(const Machine& machine, double seconds) {
    constexpr double kWindow = 0.01;
    double made = 0;
    for (double time = 0; time < seconds; time += kWindow) {
      made += kWindow * machine.pace(size_.of(most_));
      use_.seconds += kWindow;
      use_.on_core += machine.share * kWindow;
      use_.preemptions += machine.preempts ? 2 : 0;
      size_.note(use_, most_);
    }
    return made;
  }

  int threads() const { return size_.of(most_); }

 private:
  int most_;
  TeamSize size_;
  CoreUse use_;
};

TEST(TeamSizeTest, AQuietMachineUsesAllThreads) {
  for (const auto& machine : {kQuiet, kSleeping}) {
    Thread thread(4);
    EXPECT_NEAR(thread.run(machine, 1), 4000, 1);
  }
}

TEST(TeamSizeTest, ABusyMachineUsesOneThread) {
  for (const int most : {2, 8, 64}) {
    Thread thread(most);
    EXPECT_GT(thread.run(kBusy, 2), 0.85 * 2000) << most;  // 400 with all threads
  }
}

TEST(TeamSizeTest, ThreadsReturnWhenTheMachineIsQuiet) {
  Thread thread(4);
  thread.run(kBusy, 1);
  thread.run(kQuiet, 1);
  EXPECT_EQ(thread.threads(), 4);
}

}  // namespace
}  // namespace flbc
