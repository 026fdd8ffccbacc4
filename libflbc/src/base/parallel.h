// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! OpenMP helpers: the number of threads, and sums that do not depend on it.
#pragma once

#include <omp.h>

#include <algorithm>
#include <vector>

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

//! Calls `body(begin, end)` for blocks of [0, count) in parallel and adds up what it returns. The
//! blocks and the order of the sum are fixed, so the result is the same for any number of threads.
template <class Sum, class Body>
Sum parallel_sum(Index count, Sum zero, const Body& body) {
  constexpr Index kBlock = 64;
  const Index num_blocks = (count + kBlock - 1) / kBlock;
  std::vector<Sum> partial(num_blocks, zero);
  // Starting threads costs about as much as a few blocks of work.
#pragma omp parallel for schedule(static) if (num_blocks >= 8)
  for (Index block = 0; block < num_blocks; ++block) {
    partial[block] = body(block * kBlock, std::min(count, (block + 1) * kBlock));
  }
  Sum sum = zero;
  for (const Sum& part : partial) sum += part;
  return sum;
}

//! The first index in [0, count) for which a predicate holds, or count if there is none. Evaluates
//! the predicate in parallel, at least for all indices up to the result. \param holds  bool(Index);
//! must not throw
template <class Predicate>
Index first_where(Index count, const Predicate& holds) {
  constexpr Index kFewest = 1000;
  Index first = count;
#pragma omp parallel for schedule(static) reduction(min : first) if (count >= kFewest)
  for (Index k = 0; k < count; ++k) {
    if (k < first && holds(k)) first = k;
  }
  return first;
}

}  // namespace flbc
