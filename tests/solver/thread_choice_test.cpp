// SPDX-License-Identifier: BSD-3-Clause
#include "solver/run/thread_choice.h"

#include "support/test.h"

namespace flbc {
namespace {

// Seconds per iteration with a number of threads, and whether other programs run.
struct Machine {
  std::function<double(int threads)> pace;
  bool is_busy;
};

constexpr double kSecond = 1;

// Iterates for some seconds. \return iterations made
int iterate(ThreadChoice& choice, const Machine& machine, double seconds) {
  int made = 0;
  for (double time = 0; time < seconds; ++made) {
    const double pace = machine.pace(choice.threads());
    choice.note(1, pace, machine.is_busy ? 0.6 * pace : pace);
    time += pace;
  }
  return made;
}

const Machine kQuiet{[](int threads) { return 1e-3 / threads; }, false};
// Threads that wait for one without a core gain nothing.
const Machine kBusy{[](int threads) { return threads == 1 ? 1e-3 : 5e-3; }, true};
// More threads help although other programs run.
const Machine kShared{[](int threads) { return 2e-3 / threads; }, true};

TEST(ThreadChoiceTest, AQuietMachineUsesAllThreads) {
  ThreadChoice choice(4);
  const int made = iterate(choice, kQuiet, kSecond);
  EXPECT_EQ(choice.threads(), 4);
  EXPECT_NEAR(made, 4000, 1);
}

TEST(ThreadChoiceTest, ABusyMachineUsesOneThread) {
  ThreadChoice choice(8);
  const int made = iterate(choice, kBusy, kSecond);
  EXPECT_EQ(choice.threads(), 1);
  EXPECT_GT(made, 600);  // 200 with all threads, 1,000 with one
}

TEST(ThreadChoiceTest, ThreadsThatHelpAreKept) {
  ThreadChoice choice(2);
  EXPECT_GT(iterate(choice, kShared, 4 * kSecond), 0.93 * 4000);
}

TEST(ThreadChoiceTest, ThreadsReturnWhenTheMachineIsQuiet) {
  ThreadChoice choice(4);
  iterate(choice, kBusy, kSecond);
  iterate(choice, kQuiet, 2 * kSecond);
  EXPECT_EQ(choice.threads(), 4);
}

}  // namespace
}  // namespace flbc
