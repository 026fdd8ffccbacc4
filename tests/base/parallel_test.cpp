// SPDX-License-Identifier: BSD-3-Clause
// Tests of parallel loops: each index once, the order of sums, and exceptions.
#include "base/parallel.h"

#include <atomic>
#include <new>

#include "support/test.h"

namespace flbc {
namespace {

constexpr Index kCounts[] = {0, 1, 2, 63, 64, 65, 255, 256, 257, 1000};

// Calls check() with one to four threads.
template <class Check>
void with_threads(const Check& check) {
  for (const int threads : {1, 2, 3, 4}) {
    SCOPED_TRACE(threads);
    const ThreadScope scope(threads);
    check();
  }
}

TEST(Parallel, LoopsVisitEachIndexOnce) {
  with_threads([] {
    for (const Index count : kCounts) {
      const std::vector<int> once(count, 1);
      std::vector<int> visits(count, 0);
      parallel_for(count, [&](Index k) { ++visits[k]; });
      EXPECT_EQ(visits, once);
      parallel_for(
          count,
          [&](Index begin, Index end) {
            for (Index k = begin; k < end; ++k) --visits[k];
          },
          1);
      EXPECT_EQ(visits, std::vector<int>(count, 0));
      for (const Index chunk : {1, 2, 64, 2000}) {
        visits.assign(count, 0);
        parallel_for_chunks(count, chunk, [&](Index k) { ++visits[k]; });
        EXPECT_EQ(visits, once);
      }
    }
  });
}

TEST(Parallel, EachThreadHasItsOwnScratch) {
  with_threads([] {
    std::atomic<int> made{0};
    std::vector<int> scratch_of(1000);
    parallel_for_chunks(
        1000, 10, [&] { return std::vector<int>{made++}; },
        [&](Index k, std::vector<int>& scratch) { scratch_of[k] = scratch.front(); });
    EXPECT_LE(made, omp_get_max_threads());
    for (Index k = 0; k < 1000; ++k) EXPECT_EQ(scratch_of[k], scratch_of[k - k % 10]);
  });
}

// Bodies may use omp_get_thread_num(), also where the caller is in a team of its own.
TEST(Parallel, OneThreadHasNumberZeroAndNoTeam) {
  const auto check = [](bool several) {
    const int level = omp_get_level();
    const bool first = omp_get_thread_num() == 0;
    int calls = 0;
    in_threads(several, [&](int thread, int num_threads) {
      ++calls;
      EXPECT_EQ(thread, 0);
      EXPECT_EQ(omp_get_thread_num(), 0);
      EXPECT_EQ(num_threads, 1);
      EXPECT_EQ(omp_get_level() == level, first);
    });
    EXPECT_EQ(calls, 1);
  };
  check(false);
#pragma omp parallel num_threads(3)
  {
    const ThreadScope scope(1);
    check(false);
    check(true);
  }
}

TEST(Parallel, TheLowestExceptionReachesTheCaller) {
  with_threads([] {
    testing::expect_error<std::runtime_error>(
        [] {
          parallel_for(1000, [](Index k) {
            if (k % 300 == 299) throw std::runtime_error(std::to_string(k));
          });
        },
        {"299"});
  });
}

TEST(Parallel, FailedAllocationsReachTheCaller) {
  const auto fail_at = [](Index bad) {
    return [bad](Index k) {
      if (k == bad) throw std::bad_alloc();
    };
  };
  with_threads([&] {
    for (const Index bad : {0, 500, 999}) {
      EXPECT_THROW(parallel_for(1000, fail_at(bad)), std::bad_alloc);
      EXPECT_THROW(parallel_for_chunks(1000, 8, fail_at(bad)), std::bad_alloc);
      EXPECT_THROW(first_where(1000, [&](Index k) { return fail_at(bad)(k), false; }),
                   std::bad_alloc);
      const auto sum = [&](Index begin, Index end) {
        for (Index k = begin; k < end; ++k) fail_at(bad)(k);
        return 0;
      };
      EXPECT_THROW(parallel_sum(1000, 0, sum), std::bad_alloc);
    }
    const auto make_scratch = []() -> int { throw std::bad_alloc(); };
    EXPECT_THROW(parallel_for_chunks(1000, 8, make_scratch, [](Index, int) {}), std::bad_alloc);
  });
}

TEST(Parallel, SumsDoNotDependOnThreads) {
  const auto harmonic = [](Index count) {
    return parallel_sum(count, 0.0, [](Index begin, Index end) {
      double sum = 0;
      for (Index k = begin; k < end; ++k) sum += 1.0 / (k + 1);
      return sum;
    });
  };
  for (const Index count : kCounts) {
    const ThreadScope scope(1);
    const double alone = harmonic(count);
    double expected = 0;
    for (Index k = 0; k < count; ++k) expected += 1.0 / (k + 1);
    EXPECT_NEAR(alone, expected, 1e-13);
    with_threads([&] { EXPECT_EQ(harmonic(count), alone); });
  }
}

TEST(Parallel, FindsTheFirst) {
  with_threads([] {
    for (const Index step : {1, 300, 999, 2000}) {
      const auto holds = [&](Index k) { return k % step == step - 1; };
      EXPECT_EQ(first_where(1000, holds), std::min<Index>(1000, step - 1));
    }
  });
}

}  // namespace
}  // namespace flbc
