// SPDX-License-Identifier: BSD-3-Clause
#include "front/system/system.h"

#ifndef NOMINMAX
#define NOMINMAX
#endif
#define WIN32_LEAN_AND_MEAN
#include <fcntl.h>
#include <io.h>
#include <windows.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <filesystem>

#include "front/system/held_signals.h"

namespace flbc::app {
namespace {

constexpr int kNumHeld = 3;
constexpr int kHeld[kNumHeld] = {SIGINT, SIGTERM, SIGBREAK};
volatile std::sig_atomic_t came = 0;

}  // namespace

void adapt_to_system() {
  // Otherwise Windows changes ends of lines, and so the bytes of results.
  _setmode(_fileno(stdin), _O_BINARY);
  _setmode(_fileno(stdout), _O_BINARY);
  SetConsoleOutputCP(CP_UTF8);
}

bool is_terminal() {
  return _isatty(_fileno(stderr)) != 0;
}

void write_to_terminal(const std::string& text) {
  [[maybe_unused]] const auto written =
      _write(_fileno(stderr), text.data(), static_cast<unsigned>(text.size()));
}

std::string why_not_writable(const std::string& folder) {
  constexpr int kWrite = 2;
  return _waccess(std::filesystem::path(folder).c_str(), kWrite) == 0 ? "" : std::strerror(errno);
}

struct HeldSignals::Before {
  void (*actions[kNumHeld])(int);
};

HeldSignals::HeldSignals() : before_(std::make_unique<Before>()) {
  came = 0;
  for (int k = 0; k < kNumHeld; ++k) {
    before_->actions[k] = std::signal(kHeld[k], [](int signal) { came = signal; });
  }
}

HeldSignals::~HeldSignals() {
  for (int k = 0; k < kNumHeld; ++k) std::signal(kHeld[k], before_->actions[k]);
  if (came != 0) std::raise(came);
}

bool HeldSignals::has_signal() const {
  return came != 0;
}

}  // namespace flbc::app
