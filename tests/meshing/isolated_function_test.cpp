// SPDX-License-Identifier: BSD-3-Clause
// Functions in another process, on every system.
#include <chrono>
#include <new>
#include <thread>

#include "meshing/isolated_process.h"
#include "support/child_processes.h"
#include "support/test.h"

namespace flbc {
namespace {

std::vector<char> bytes_of(const std::string& text) {
  return {text.begin(), text.end()};
}

int changed_by_child = 0;

void send_twice(const std::vector<char>& input, const ByteSink& send) {
  changed_by_child = 1;
  send(input.data(), input.size());
  send(input.data(), input.size());
}

TEST(IsolatedFunction, ReceivesItsInputAndChangesNothingHere) {
  for (const std::size_t size : {0, 3, 5'000'000}) {
    std::string text(size, 'a');
    for (std::size_t k = 0; k < size; ++k) text[k] = static_cast<char>('a' + k % 26);
    const auto outcome = run_isolated(send_twice, bytes_of(text), 60);
    EXPECT_EQ(outcome.end, ProcessEnd::kFinished);
    EXPECT_TRUE(outcome.output == bytes_of(text + text)) << size;
  }
  EXPECT_EQ(changed_by_child, 0);
}

ProcessOutcome run_function(IsolatedFunction function, double time_limit = 60) {
  return run_isolated(function, {}, time_limit);
}

TEST(IsolatedFunction, FailuresEndTheOtherProcessOnly) {
  EXPECT_EQ(run_function([](const auto&, const auto&) { throw std::runtime_error("x"); }).end,
            ProcessEnd::kThrew);
  EXPECT_EQ(run_function([](const auto&, const auto&) { throw 1; }).end, ProcessEnd::kThrew);
  EXPECT_EQ(run_function([](const auto&, const auto&) { std::abort(); }).end, ProcessEnd::kCrashed);
  const auto crash = run_function([](const auto&, const auto&) {
    volatile int* volatile nowhere = nullptr;
    *nowhere = 1;
  });
  EXPECT_EQ(crash.end, ProcessEnd::kCrashed);
  EXPECT_FALSE(describe_signal(crash.signal).empty());
  EXPECT_THROW(run_function([](const auto&, const auto&) { throw std::bad_alloc(); }),
               std::bad_alloc);
}

TEST(IsolatedFunction, TimeLimitEndsIt) {
  const auto sleep = [](const std::vector<char>&, const ByteSink&) {
    std::this_thread::sleep_for(std::chrono::seconds(60));
  };
  EXPECT_EQ(run_function(sleep, 0.3).end, ProcessEnd::kTimedOut);
}

TEST(IsolatedFunction, MayRecurseDeeply) {
  const auto outcome = run_function([](const auto&, const ByteSink& send) {
    const int depth = testing::depth_of(6000);
    send(&depth, sizeof depth);
  });
  EXPECT_EQ(outcome.end, ProcessEnd::kFinished);
  int depth = 0;
  ByteSource(outcome.output, [] { FAIL() << "too little output"; }).take(&depth, 1);
  EXPECT_EQ(depth, 6000);
}

}  // namespace
}  // namespace flbc
