// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Reads whole files, and writes files atomically.
#pragma once

#include <functional>
#include <iosfwd>
#include <string>

namespace flbc::io {

//! Returns the content of a file, or of standard input for "-".
//! \throws IoError with the system error
std::string read_file(const std::string& path);

//! Lets `write` fill a temporary file next to `path`, then renames it to `path`. If anything fails,
//! including an exception from `write`, the temporary file is removed and an existing file is
//! unchanged. "-" writes to standard output.
//! \throws IoError with the system error
void write_file(const std::string& path, const std::function<void(std::ostream&)>& write);

//! The extension in lowercase without the dot; empty if there is none.
std::string extension_of(const std::string& path);

}  // namespace flbc::io
