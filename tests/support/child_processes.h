// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sys/wait.h>

#include <cerrno>

namespace flbc::testing {

//! Whether this process has children, also ended ones that nothing has waited for.
inline bool has_child() {
  return waitpid(-1, nullptr, WNOHANG) >= 0 || errno != ECHILD;
}

}  // namespace flbc::testing
