// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#ifdef _WIN32
#ifndef NOMINMAX
#define NOMINMAX
#endif
#define WIN32_LEAN_AND_MEAN
#include <windows.h>

#include <tlhelp32.h>
#else
#include <sys/wait.h>

#include <cerrno>
#endif

namespace flbc::testing {

//! The number of levels, counted by calls of itself that take 1 KiB of the stack each.
inline int depth_of(int levels) {
  volatile char room[1024];
  room[0] = static_cast<char>(levels);
  return levels == 0 ? 0 : depth_of(levels - 1) + (room[0] == static_cast<char>(levels) ? 1 : 0);
}

//! Whether this process has children, also ended ones that nothing has waited for.
inline bool has_child() {
#ifdef _WIN32
  const HANDLE all = CreateToolhelp32Snapshot(TH32CS_SNAPPROCESS, 0);
  PROCESSENTRY32 entry{};
  entry.dwSize = sizeof entry;
  bool found = false;
  for (BOOL more = Process32First(all, &entry); more != 0; more = Process32Next(all, &entry)) {
    found = found || entry.th32ParentProcessID == GetCurrentProcessId();
  }
  CloseHandle(all);
  return found;
#else
  return waitpid(-1, nullptr, WNOHANG) >= 0 || errno != ECHILD;
#endif
}

}  // namespace flbc::testing
