// SPDX-License-Identifier: BSD-3-Clause
// What the program asks of the system in other ways than the standard library. Only this folder
// includes headers of POSIX or Windows.
#pragma once

#include <string>

namespace flbc::app {

//! To be called first in main(): limits of the system end in messages rather than in signals, and
//! standard streams that are closed are occupied.
void adapt_to_system();

//! Whether standard error is a terminal.
bool is_terminal();
//! Writes to standard error without buffers, which a mesher's child process would inherit half
//! filled.
void write_to_terminal(const std::string& text);

//! \return why files cannot be made in this folder; empty if they can
std::string why_not_writable(const std::string& folder);

}  // namespace flbc::app
