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
#include <system_error>

#include "flbc/errors.h"
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

struct FolderLock::Handle {
  HANDLE file;
};

// A file that exists while the folder is locked.
FolderLock::FolderLock(const std::string& folder, const std::string& command) {
  const auto path = std::filesystem::path(folder) / ".flbc-lock";
  const HANDLE file = CreateFileW(path.c_str(), GENERIC_WRITE, 0, nullptr, CREATE_ALWAYS,
                                  FILE_FLAG_DELETE_ON_CLOSE, nullptr);
  if (file == INVALID_HANDLE_VALUE) {
    const DWORD error = GetLastError();
    if (error == ERROR_SHARING_VIOLATION || error == ERROR_ACCESS_DENIED) {
      throw IoError(folder + ": another flbc " + command +
                    " is writing to this folder; wait for it, or use another folder");
    }
    throw IoError(folder + ": cannot open this folder: " +
                  std::system_category().message(static_cast<int>(error)));
  }
  handle_ = std::make_unique<Handle>(Handle{file});
}

FolderLock::~FolderLock() {
  CloseHandle(handle_->file);
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
