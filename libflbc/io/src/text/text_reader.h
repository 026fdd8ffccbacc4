// SPDX-License-Identifier: BSD-3-Clause
// Reads a text file word by word and tracks the line number.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "flbc/types.h"

namespace flbc::io {

//! A cursor over a text. Words are separated by blanks; a line ends with LF, CRLF, or, if the text
//! has no LF, CR. All errors are
//! InputErrors that start with "FILE:LINE: ". Numbers do not depend on the locale.
class TextReader {
 public:
  struct Syntax {
    char comment = '\0';           //!< starts a comment that lasts to the end of the line
    bool continued_lines = false;  //!< a backslash at the end of a line joins the next line to it
  };

  //! \param path the file's name for messages \param text the file's content, or a part of it
  //! \param first_line line number of the start of the text
  TextReader(const std::string& path, std::string text, Syntax syntax, std::int64_t first_line = 1);

  //! Moves to the next line that has a word. \return false at the end of the file
  bool next_line();

  //! next_line(), or throws that the file ends after `done` of `declared` `things`.
  void next_line_of(const char* things, std::int64_t done, std::int64_t declared);

  //! Moves to the next line if no word is left on this one. \return false at the end of the file
  bool next_word_on_any_line();

  //! next_word_on_any_line(), or throws that the file ends after `done` of `declared` `things`.
  void next_word_of(const char* things, std::int64_t done, std::int64_t declared);

  //! True if a word is left on this line.
  bool has_word();

  //! The next word on this line; empty if none is left. Valid during the lifetime of the reader.
  std::string_view word();

  //! The word that word() would return, without moving on.
  std::string_view peek();

  //! Puts back the last characters of the word that was read last.
  void put_back(std::size_t characters) { position_ -= characters; }

  //! The next word on this line as a finite number; one too small for a double counts as 0.
  double number();

  //! The same, but infinity and NaN are numbers, too.
  double any_number();

  //! The next three words on this line as a point.
  Vector<3> point();

  //! The next word on this line as an integer.
  std::int64_t integer();

  //! The next word on this line as the number of `things`, each of which takes at least
  //! `bytes_each` bytes of the rest of the file. Throws if the file cannot hold this number, so
  //! allocation is safe; 0 disables this check.
  Index count(const char* things, std::size_t bytes_each);

  //! The next word on this line as one of `count` `things`, which are numbered from `first`.
  //! \return the index from 0
  Index index(const char* things, std::int64_t first, Index count);

  //! The next word in the file; throws that the file ends where EXPECTED was expected.
  std::string_view word_on_any_line(const char* expected);

  //! Throws if a word is left on this line.
  void expect_end_of_line();

  //! Throws if a word is left in the file.
  void expect_end_of_file(const std::string& after);

  //! Changes the comment character for the following lines.
  void set_comment(char comment) { syntax_.comment = comment; }

  //! Bytes that have not been read yet.
  std::size_t bytes_left() const { return text_.size() - position_; }

  //! The current line, from 1.
  std::int64_t line() const { return line_; }

  //! Throws the InputError `FILE:LINE: message`.
  [[noreturn]] void fail(const std::string& message) const { fail_at(line_, message); }
  [[noreturn]] void fail_at(std::int64_t line, const std::string& message) const;

  //! fail() with "expected EXPECTED, found WORD".
  [[noreturn]] void fail_expected(const std::string& expected, std::string_view found) const;

 private:
  bool skip_continuation();
  double number_in(std::string_view word) const;
  double number_out_of_range(std::string_view word) const;

  std::string name_;
  std::string text_;
  Syntax syntax_;
  std::size_t position_ = 0;
  std::int64_t line_;
  bool started_ = false;
};

std::string lower_case(std::string_view text);

//! A word without its plus sign, which std::from_chars() does not accept.
std::string_view without_plus(std::string_view word);

//! A quoted piece of a file for messages: short and printable.
std::string in_quotes(std::string_view text);

//! "the index INDEX is out of range; THINGS are numbered FIRST to ...", for `count` things.
std::string out_of_range_message(std::int64_t index, const char* things, std::int64_t first,
                                 std::size_t count);

}  // namespace flbc::io
