// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Each measurement runs in a process of its own: its peak memory is its own, nothing is warm from
//! the one before, and a failure ends one row, not the program.
#pragma once

#include <functional>
#include <optional>
#include <string>

namespace flbc::bench {

//! Runs `body` in a child process. The caller must not have used OpenMP, which does not survive a
//! fork. \param what  for messages
//! \return what `body` returned, or nothing after a message on stderr if it threw or crashed
std::optional<std::string> in_child(const std::string& what,
                                    const std::function<std::string()>& body);

}  // namespace flbc::bench
