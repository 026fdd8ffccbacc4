// SPDX-License-Identifier: BSD-3-Clause
#include "meshing/isolated_process.h"

#include <dirent.h>
#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <thread>

#include "support/child_processes.h"
#include "support/test.h"

namespace flbc {
namespace {

int count_open_files() {
  DIR* directory = opendir("/proc/self/fd");
  if (directory == nullptr) return -1;
  int count = 0;
  while (readdir(directory) != nullptr) ++count;
  closedir(directory);
  return count;
}

// Checks after every test that nothing was left behind.
class IsolatedProcessTest : public ::testing::Test {
 protected:
  void SetUp() override { open_before_ = count_open_files(); }
  void TearDown() override {
    EXPECT_EQ(count_open_files(), open_before_);
    EXPECT_FALSE(testing::has_child());
  }

 private:
  int open_before_ = 0;
};

// Daemons and job systems start programs without standard streams.
TEST_F(IsolatedProcessTest, WorksWithoutStandardStreams) {
  for (const auto& streams : {std::vector<int>{0, 1}, {0, 2}, {1, 2}, {0, 1, 2}}) {
    std::vector<int> kept;
    for (const int stream : streams) {
      kept.push_back(fcntl(stream, F_DUPFD_CLOEXEC, 100));
      close(stream);
    }
    const auto outcome = run_isolated(
        [](const ByteSink& send) {
          std::fprintf(stderr, "child");
          send("done", 4);
        },
        60);
    for (std::size_t k = 0; k < streams.size(); ++k) {
      dup2(kept[k], streams[k]);
      close(kept[k]);
    }
    EXPECT_EQ(outcome.end, ProcessEnd::kFinished);
    EXPECT_EQ(std::string(outcome.output.begin(), outcome.output.end()), "done");
  }
}

TEST_F(IsolatedProcessTest, CrashIsReportedWithItsSignal) {
  for (int signal : {SIGSEGV, SIGABRT, SIGFPE}) {
    const ProcessOutcome outcome = run_isolated([&](const ByteSink&) { raise(signal); }, 60);
    EXPECT_EQ(outcome.end, ProcessEnd::kCrashed);
    EXPECT_EQ(outcome.signal, signal);
    flbc::testing::expect_piece(describe_signal(signal), std::to_string(signal));
  }
}

TEST_F(IsolatedProcessTest, CrashIsReportedEvenIfTheParentHandlesTheSignal) {
  const auto before = std::signal(SIGSEGV, [](int) { std::_Exit(0); });
  const ProcessOutcome outcome = run_isolated([](const ByteSink&) { raise(SIGSEGV); }, 60);
  std::signal(SIGSEGV, before);
  EXPECT_EQ(outcome.end, ProcessEnd::kCrashed);
}

TEST_F(IsolatedProcessTest, ASmallStackIsNoObstacle) {
  rlimit before{};
  getrlimit(RLIMIT_STACK, &before);
  const rlimit small{128 << 10, before.rlim_max};
  setrlimit(RLIMIT_STACK, &small);
  rlimit now{};
  getrlimit(RLIMIT_STACK, &now);
  if (now.rlim_cur != small.rlim_cur) GTEST_SKIP() << "QEMU ignores limits of the stack";
  constexpr int kLevels = 8000;  // 8 MiB
  const auto outcome = run_isolated(
      [](const ByteSink& send) {
        const int depth = testing::depth_of(kLevels);
        send(&depth, sizeof depth);
      },
      60);
  setrlimit(RLIMIT_STACK, &before);
  EXPECT_EQ(outcome.end, ProcessEnd::kFinished);
  int depth = 0;
  ASSERT_EQ(outcome.output.size(), sizeof depth);
  std::memcpy(&depth, outcome.output.data(), sizeof depth);
  EXPECT_EQ(depth, kLevels);
}

TEST_F(IsolatedProcessTest, TimeLimitStopsABusyWriter) {
  const auto writer = [](const ByteSink& send) {
    while (true) {
      send("x", 1);
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
  };
  EXPECT_EQ(run_isolated(writer, 0.2).end, ProcessEnd::kTimedOut);
}

TEST_F(IsolatedProcessTest, WhatTheChildPrintsIsDiscarded) {
  ::testing::internal::CaptureStdout();
  ::testing::internal::CaptureStderr();
  std::printf("parent ");  // buffered here, and must not come out twice
  run_isolated(
      [](const ByteSink&) {
        std::printf("child");
        std::fprintf(stderr, "child");
        std::fflush(stdout);
      },
      60);
  EXPECT_EQ(::testing::internal::GetCapturedStdout(), "parent ");
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
}

TEST_F(IsolatedProcessTest, SignalsToTheParentDoNotDisturb) {
  struct sigaction action {
  }, before{};
  action.sa_handler = [](int) {};
  sigaction(SIGALRM, &action, &before);  // without SA_RESTART: system calls return EINTR
  ualarm(20000, 20000);
  const ProcessOutcome outcome = run_isolated(
      [](const ByteSink& send) {
        std::this_thread::sleep_for(std::chrono::milliseconds(300));
        send("done", 4);
      },
      60);
  ualarm(0, 0);
  sigaction(SIGALRM, &before, nullptr);
  EXPECT_EQ(outcome.end, ProcessEnd::kFinished);
  EXPECT_EQ(std::string(outcome.output.begin(), outcome.output.end()), "done");
}

TEST_F(IsolatedProcessTest, RunsFromSeveralThreadsDoNotMix) {
  std::vector<std::thread> threads;
  std::vector<std::string> received(4);
  for (std::size_t t = 0; t < received.size(); ++t) {
    threads.emplace_back([&received, t] {
      for (int run = 0; run < 10; ++run) {
        const std::string text = std::to_string(t);
        const auto outcome =
            run_isolated([&](const ByteSink& send) { send(text.data(), text.size()); }, 60);
        received[t].append(outcome.output.begin(), outcome.output.end());
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  for (std::size_t t = 0; t < received.size(); ++t) {
    EXPECT_EQ(received[t], std::string(10, char('0' + int(t))));
  }
}

TEST_F(IsolatedProcessTest, WhatPollThrowsEndsTheChild) {
  int calls = 0;
  const auto poll = [&] {
    if (++calls == 3) throw std::runtime_error("cancelled");
  };
  const auto sleep = [](const ByteSink&) {
    while (true) std::this_thread::sleep_for(std::chrono::seconds(1));
  };
  EXPECT_THROW(run_isolated(sleep, {1000, poll}), std::runtime_error);
  EXPECT_EQ(calls, 3);
}

}  // namespace
}  // namespace flbc
