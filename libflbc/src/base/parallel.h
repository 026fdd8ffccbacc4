// SPDX-License-Identifier: BSD-3-Clause
// Loops and sums in parallel, and the number of threads. Results do not depend on that number, and
// exceptions reach the caller.
#pragma once

#include <omp.h>

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <exception>
#include <type_traits>
#include <vector>

#include "base/team_size.h"
#include "flbc/types.h"

namespace flbc {

//! Number of threads for an array of the given size that an iteration reads a few times. Threads
//! that synchronize every few microseconds gain little, and lose much on busy cores. \param wanted
//! number set by the user; 0 = automatic
inline int threads_for(int wanted, Index rows, Index columns) {
  constexpr double kFewest = 1e5;
  if (wanted > 0) return wanted;
  return static_cast<double>(rows) * columns < kFewest ? 1 : 0;
}

//! Sets the number of threads for parallel regions entered by this thread, until it goes out of
//! scope.
class ThreadScope {
 public:
  explicit ThreadScope(int threads) : before_(omp_get_max_threads()) {
    if (threads > 0) omp_set_num_threads(threads);
  }
  ~ThreadScope() { omp_set_num_threads(before_); }
  ThreadScope(const ThreadScope&) = delete;
  ThreadScope& operator=(const ThreadScope&) = delete;

 private:
  int before_;
};

//! The number of elements that an array needs for several threads: starting them costs about as
//! much as going through a few hundred elements.
constexpr int kFewestInParallel = 256;

//! Calls body(thread, number of threads) once in each thread of a team. When all are done, rethrows
//! the exception of the first thread that threw one. \param several  false: the calling thread
//! only. Teams seldom differ in size otherwise, since OpenMP ends and starts threads each time
template <class Body>
void in_threads(bool several, const Body& body) {
  // Even a region of one thread creates and closes semaphores on Windows. They are slow under Wine.
  const int threads = several ? team_size() : 1;
  if (threads == 1 && omp_get_thread_num() == 0) return body(0, 1);
  std::exception_ptr error;
  int first = threads;
#pragma omp parallel num_threads(threads)
  {
    const int thread = omp_get_thread_num();
    try {
      body(thread, omp_get_num_threads());
    } catch (...) {
#pragma omp critical(flbc_error)
      if (thread < first) {
        first = thread;
        error = std::current_exception();
      }
    }
  }
  if (error) std::rethrow_exception(error);
}

//! Calls a body for [0, count) in parallel: `body(k)` for each k, or `body(begin, end)` once per
//! thread, which can hold what the thread needs. The exception of the lowest k reaches the caller.
//! \param fewest  the least count for several threads
template <class Integer, class Body>
void parallel_for(Integer count, const Body& body, int fewest = kFewestInParallel) {
  const auto size = static_cast<std::int64_t>(count);
  in_threads(size >= fewest, [&](int thread, int num_threads) {
    const auto begin = static_cast<Integer>(size * thread / num_threads);
    const auto end = static_cast<Integer>(size * (thread + 1) / num_threads);
    if constexpr (std::is_invocable_v<const Body&, Integer, Integer>) {
      if (begin < end) body(begin, end);
    } else {
      for (Integer k = begin; k < end; ++k) body(k);
    }
  });
}

//! Calls body(k, scratch) for each k in [0, count) in parallel, if the work for some k takes much
//! longer than for others: a thread that is done takes the next chunk. An exception reaches the
//! caller, and the remaining chunks are left out. \param make_scratch  called once per thread
template <class MakeScratch, class Body>
void parallel_for_chunks(Index count, Index chunk, const MakeScratch& make_scratch,
                         const Body& body) {
  std::atomic<std::int64_t> next{0};
  in_threads(count > chunk, [&](int, int) {
    try {
      auto scratch = make_scratch();
      for (std::int64_t begin = 0; (begin = next.fetch_add(chunk)) < count;) {
        const auto end = static_cast<Index>(std::min<std::int64_t>(count, begin + chunk));
        for (auto k = static_cast<Index>(begin); k < end; ++k) body(k, scratch);
      }
    } catch (...) {
      next = count;
      throw;
    }
  });
}

//! The same for a body(k) without scratch memory.
template <class Body>
void parallel_for_chunks(Index count, Index chunk, const Body& body) {
  parallel_for_chunks(
      count, chunk, [] { return 0; }, [&](Index k, int) { body(k); });
}

//! Calls `body(begin, end)` for blocks of [0, count) in parallel and adds up what it returns. The
//! blocks and the order of the sum are fixed, so the result is the same for any number of threads.
template <class Sum, class Body>
Sum parallel_sum(Index count, Sum zero, const Body& body) {
  constexpr Index kBlock = 64;
  const Index num_blocks = (count + kBlock - 1) / kBlock;
  std::vector<Sum> partial(num_blocks, zero);
  const auto add_up = [&](Index block) {
    partial[block] = body(block * kBlock, std::min(count, (block + 1) * kBlock));
  };
  parallel_for(num_blocks, add_up, kFewestInParallel / kBlock);
  Sum sum = zero;
  for (const Sum& part : partial) sum += part;
  return sum;
}

//! Lowers a number that other threads may lower at the same time.
inline void lower_to(std::atomic<Index>& least, Index number) {
  Index known = least.load();
  while (number < known && !least.compare_exchange_weak(known, number)) {
  }
}

//! The first index in [0, count) for which a predicate holds, or count if there is none. Evaluates
//! the predicate in parallel, at least for all indices up to the result. \param holds  bool(Index)
template <class Predicate>
Index first_where(Index count, const Predicate& holds) {
  std::atomic<Index> first{count};
  parallel_for(count, [&](Index k) {
    if (k < first.load(std::memory_order_relaxed) && holds(k)) lower_to(first, k);
  });
  return first;
}

}  // namespace flbc
