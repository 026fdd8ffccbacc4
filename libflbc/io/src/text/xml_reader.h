// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Walks over the tags of an XML file and knows in which line it is.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "text/text_reader.h"

namespace flbc::io {

//! As much XML as data files need: tags with attributes, the five named and the numeric entities in
//! attributes; comments, declarations and processing instructions are passed over. Whether tags are
//! closed in order is not checked. All errors are InputErrors that start with "FILE:LINE: ".
class XmlReader {
 public:
  XmlReader(std::string path, std::string content);

  //! Moves to the next tag. \return false at the end of the file
  bool next_tag();

  //! The tag's name, without the slash of an end tag.
  const std::string& name() const { return name_; }
  bool is_end_tag() const { return is_end_tag_; }

  //! The attribute's value; empty if there is none.
  std::string attribute(const std::string& name) const;

  //! The text between this tag and the next one.
  TextReader text();

  //! The line of what comes next, from 1.
  std::int64_t line() const { return line_; }

  //! Throws the InputError `FILE:LINE: message` for this line.
  [[noreturn]] void fail(const std::string& message) const;

 private:
  std::size_t find_end_of_tag() const;
  void skip_past(std::string_view end, const char* what);
  void parse_tag(std::string_view tag);
  std::string decoded(std::string_view text) const;
  std::string decoded_entity(std::string_view entity) const;
  void move_to(std::size_t position);

  std::string path_;
  std::string content_;
  std::size_t position_ = 0;
  std::int64_t line_ = 1;  // of position_
  std::string name_;
  bool is_end_tag_ = false;
  std::vector<std::pair<std::string, std::string>> attributes_;
};

}  // namespace flbc::io
