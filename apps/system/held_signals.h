// SPDX-License-Identifier: BSD-3-Clause
// Interrupts wait while results are written, so that no temporary file is left behind.
#pragma once

#include <csignal>

namespace flbc::app {

//! Holds back SIGINT, SIGTERM and SIGHUP while it lives; one that came ends the program afterwards.
//! Waiting for the reader of a pipe is interrupted, which makes writing fail. One at a time.
class HeldSignals {
 public:
  HeldSignals() {
    came() = 0;
    for (int k = 0; k < kCount; ++k) {
      sigaction(kSignals[k], nullptr, &before_[k]);
      if (before_[k].sa_handler == SIG_IGN) continue;  // as nohup wants it
      struct sigaction hold = {};
      hold.sa_handler = [](int signal) { came() = signal; };
      sigaction(kSignals[k], &hold, nullptr);
    }
  }
  ~HeldSignals() {
    for (int k = 0; k < kCount; ++k) sigaction(kSignals[k], &before_[k], nullptr);
    if (came() != 0) raise(came());
  }

  bool has_signal() const { return came() != 0; }

  HeldSignals(const HeldSignals&) = delete;
  HeldSignals& operator=(const HeldSignals&) = delete;

 private:
  static constexpr int kCount = 3;
  static constexpr int kSignals[kCount] = {SIGINT, SIGTERM, SIGHUP};

  static volatile std::sig_atomic_t& came() {
    static volatile std::sig_atomic_t signal;
    return signal;
  }

  struct sigaction before_[kCount];
};

}  // namespace flbc::app
