// SPDX-License-Identifier: BSD-3-Clause
#include "front/system/system.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>
#include <utility>

#ifdef __GLIBC__
#include <malloc.h>
#endif

#include "front/system/held_signals.h"

namespace flbc::app {
namespace {

// Where a standard stream is closed, the next file would get its number, and messages would go into
// that file. What takes its place fails in use, as the closed one would; only messages may be lost.
void occupy_standard_streams() {
  constexpr std::pair<int, int> kStreams[] = {
      {STDIN_FILENO, O_WRONLY}, {STDOUT_FILENO, O_RDONLY}, {STDERR_FILENO, O_WRONLY}};
  for (const auto& [stream, mode] : kStreams) {
    if (fcntl(stream, F_GETFD) < 0) open("/dev/null", mode);  // gets the smallest free number
  }
}

constexpr int kNumHeld = 3;
constexpr int kHeld[kNumHeld] = {SIGINT, SIGTERM, SIGHUP};
volatile std::sig_atomic_t came = 0;

}  // namespace

void adapt_to_system() {
  occupy_standard_streams();
  std::signal(SIGXFSZ, SIG_IGN);  // a file that may not grow fails to be written
  std::signal(SIGPIPE, SIG_IGN);  // messages that nobody reads must not end a solve
#ifdef __GLIBC__
  // Matrices go back to the system when they are freed. By default freed memory of their size is
  // kept, in pieces between others, which costs a fifth of what a solve takes.
  mallopt(M_MMAP_THRESHOLD, 1 << 20);
  // Smaller blocks are freed and allocated again and again; each new page costs a page fault.
  mallopt(M_TOP_PAD, 16 << 20);
#endif
}

bool is_terminal() {
  return isatty(STDERR_FILENO) != 0;
}

void write_to_terminal(const std::string& text) {
  [[maybe_unused]] const auto written = write(STDERR_FILENO, text.data(), text.size());
}

std::string why_not_writable(const std::string& folder) {
  return access(folder.c_str(), W_OK | X_OK) == 0 ? "" : std::strerror(errno);
}

struct HeldSignals::Before {
  struct sigaction actions[kNumHeld];
};

HeldSignals::HeldSignals() : before_(std::make_unique<Before>()) {
  came = 0;
  for (int k = 0; k < kNumHeld; ++k) {
    sigaction(kHeld[k], nullptr, &before_->actions[k]);
    if (before_->actions[k].sa_handler == SIG_IGN) continue;  // as nohup wants it
    struct sigaction hold = {};
    hold.sa_handler = [](int signal) { came = signal; };
    sigaction(kHeld[k], &hold, nullptr);
  }
}

HeldSignals::~HeldSignals() {
  for (int k = 0; k < kNumHeld; ++k) sigaction(kHeld[k], &before_->actions[k], nullptr);
  if (came != 0) raise(came);
}

bool HeldSignals::has_signal() const {
  return came != 0;
}

}  // namespace flbc::app
