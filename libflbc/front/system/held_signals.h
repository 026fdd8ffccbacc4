// SPDX-License-Identifier: BSD-3-Clause
// Interrupts wait while results are written, so that no temporary file is left behind.
#pragma once

#include <memory>

namespace flbc::app {

//! Holds back SIGINT, SIGTERM and SIGHUP while it lives; one that came ends the program afterwards.
//! Waiting for the reader of a pipe is interrupted, which makes writing fail. One at a time.
class HeldSignals {
 public:
  HeldSignals();
  ~HeldSignals();
  HeldSignals(const HeldSignals&) = delete;
  HeldSignals& operator=(const HeldSignals&) = delete;

  bool has_signal() const;

 private:
  struct Before;
  std::unique_ptr<Before> before_;
};

}  // namespace flbc::app
