// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Reading whole files, and writing files that appear whole or not at all.
#pragma once

#include <functional>
#include <iosfwd>
#include <string>

namespace flbc::io {

//! The whole content of a file, or of standard input for "-".
//! \throws IoError with the system's reason
std::string read_file(const std::string& path);

//! Lets `write` fill a temporary file beside `path`, then renames it to `path`. If anything fails,
//! an exception thrown by `write` included, no trace is left and an existing file stays as it was.
//! "-" writes to standard output.
//! \throws IoError with the system's reason
void write_file(const std::string& path, const std::function<void(std::ostream&)>& write);

//! The extension in lower case without the dot; empty if there is none.
std::string extension_of(const std::string& path);

}  // namespace flbc::io
