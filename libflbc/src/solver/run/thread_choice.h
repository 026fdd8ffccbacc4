// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! The number of threads that iterate while other programs use the cores.
#pragma once

#include "base/parallel.h"
#include "base/stopwatch.h"

namespace flbc {

//! Seconds that the calling thread has had a core so far.
double seconds_on_core();

//! An iteration takes less than a millisecond, and its threads wait for each other several times.
//! If another program takes the core of one of them, all wait for it: two threads can then take ten
//! times as long as one. If threads lose their cores, this class tries half of them, then one, and
//! keeps what is faster. Later it tries again with more. Results do not depend on it.
class ThreadChoice {
 public:
  //! \param most  number of threads if nothing else runs
  explicit ThreadChoice(int most) : most_(most), threads_(most) {}

  //! The number of threads for the next iterations.
  int threads() const { return trial_ > 0 ? trial_ : threads_; }

  //! Makes iterations with threads(), and takes note of them.
  //! \param body  makes the given number of iterations
  template <class Body>
  auto with_threads(int iterations, const Body& body) {
    const ThreadScope scope(threads());
    const double on_core = seconds_on_core();
    Stopwatch watch;
    auto result = body();
    note(iterations, watch.lap(), seconds_on_core() - on_core);
    return result;
  }

  //! Takes note of iterations with threads().
  //! \param seconds  they took \param on_core  seconds that the calling thread had a core
  void note(int iterations, double seconds, double on_core);

 private:
  void judge(double pace, bool shares_core);

  const int most_;
  int threads_;
  int trial_ = 0;    // a number that is tried; 0 = none
  double pace_ = 0;  // seconds per iteration with threads_
  int pause_ = 1;    // windows until the next trial, at least
  int windows_ = 0;  // since the last trial
  // sums of the current window
  int iterations_ = 0;
  double seconds_ = 0;
  double on_core_ = 0;
};

}  // namespace flbc
