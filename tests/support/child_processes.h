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
