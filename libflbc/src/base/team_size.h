// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! The number of threads of a loop while other programs use the cores.
#pragma once

namespace flbc {

//! What a thread has had of its core.
struct CoreUse {
  double seconds = 0;    //!< by the clock
  double on_core = 0;    //!< of these: seconds in which it ran
  long preemptions = 0;  //!< how often another program took its core
};

//! Threads of a loop wait for each other every few microseconds. If another program takes the core
//! of one of them, all wait for it: two threads can then take twice as long as one. Where the
//! calling thread loses its core, half of the threads go on, and after a pause all are tried again.
//! Results do not depend on it.
class TeamSize {
 public:
  //! Takes note of how the thread has used its core since it began.
  //! \param most  number of threads where nothing else runs
  void note(const CoreUse& use, int most);

  //! The number of threads of the next loops.
  int of(int most) const { return most >> halvings_ > 1 ? most >> halvings_ : 1; }

 private:
  static constexpr int kShortestPause = 1;

  CoreUse before_;
  int halvings_ = 0;
  int pause_ = 0;  // notes until more threads are tried
  int next_pause_ = kShortestPause;
};

//! The number of threads for a loop of this thread. 1 where it is in a loop of a team already.
int team_size();

}  // namespace flbc
