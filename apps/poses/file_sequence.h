// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Sequences of files whose names contain a number, written as pose_%d.obj or pose_%03d.obj.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace flbc::app {

//! A file of a sequence.
struct NumberedFile {
  std::string path;
  std::int64_t number;
};

//! Whether a name has a place for a number. \throws OptionError if it has more than one
bool has_number(const std::string& pattern);

//! The name with the number in its place, with leading zeros up to the width between % and d. A
//! name without a place for it stays as it is.
std::string with_number(const std::string& pattern, std::int64_t number);

//! The files of a pattern that exist: from number 0 or else 1 up to the first one missing.
//! \throws IoError if there are none
std::vector<NumberedFile> find_files(const std::string& pattern);

}  // namespace flbc::app
