// SPDX-License-Identifier: BSD-3-Clause
// Fast text output of numbers.
#pragma once

#include <cmath>
#include <cstdint>
#include <ostream>
#include <string>
#include <string_view>
#include <type_traits>

#include "flbc/errors.h"
#include "text/float_chars.h"

namespace flbc::io {

//! The text for XML and HTML, with entities in place of markup characters.
inline std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    switch (c) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '"':
        result += "&quot;";
        break;
      default:
        result += c;
    }
  }
  return result;
}

//! Buffers text and writes it to a stream in large pieces. Numbers do not depend on the locale and
//! have enough digits to read the same double back, at most 17.
class TextWriter {
 public:
  explicit TextWriter(std::ostream& out) : out_(out) { buffer_.reserve(kFlushSize + kMargin); }
  TextWriter(const TextWriter&) = delete;
  TextWriter& operator=(const TextWriter&) = delete;

  TextWriter& operator<<(std::string_view text) {
    buffer_ += text;
    if (buffer_.size() >= kFlushSize) flush();
    return *this;
  }

  //! \throws InputError if the number is not finite, because no reader accepts it
  TextWriter& operator<<(double value) {
    if (!std::isfinite(value)) throw InputError("a number to be written is not finite");
    return append(value);
  }

  template <class Integer, std::enable_if_t<std::is_integral_v<Integer>, int> = 0>
  TextWriter& operator<<(Integer value) {
    static_assert(!std::is_same_v<Integer, char> && !std::is_same_v<Integer, bool>);
    return append(value);
  }

  //! Must be called at the end; the destructor does not write, because it would hide errors.
  void flush() {
    out_.write(buffer_.data(), static_cast<std::streamsize>(buffer_.size()));
    buffer_.clear();
  }

 private:
  static constexpr std::size_t kFlushSize = std::size_t{1} << 16;
  static constexpr std::size_t kMargin = 256;

  template <class Number>
  TextWriter& append(Number value) {
    char digits[32];  // the longest double has 24 characters
    const auto end = to_chars(digits, digits + sizeof digits, value).ptr;
    return *this << std::string_view(digits, static_cast<std::size_t>(end - digits));
  }

  std::ostream& out_;
  std::string buffer_;
};

}  // namespace flbc::io
