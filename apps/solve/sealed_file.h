// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Files that the program keeps for itself: a first line with the format, a key that tells what the
//! content belongs to, the content, a checksum.
#pragma once

#include <functional>
#include <iosfwd>
#include <string>
#include <string_view>

namespace flbc::app {

//! The parts of a file between its first line and its checksum.
struct SealedContent {
  std::string_view key;
  std::string_view payload;
};

//! Takes a file apart. \param content  of the whole file, outlives the result
//! \param first_line  with its end \param kind  for messages, as "weights"
//! \throws InputError saying what is wrong with the file
SealedContent open_sealed(std::string_view content, std::string_view first_line,
                          const std::string& kind);

//! Writes a file, which appears whole or not at all. \param payload  is called to write the content
//! \throws IoError
void write_sealed(const std::string& path, std::string_view first_line, const std::string& key,
                  const std::function<void(std::ostream&)>& payload);

}  // namespace flbc::app
