// SPDX-License-Identifier: BSD-3-Clause
#include "text/text_reader.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>
#include <system_error>
#include <utility>

#include "flbc/errors.h"
#include "text/float_chars.h"

namespace flbc::io {
namespace {

bool is_blank(char c) {
  return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f';
}

// Whether a decimal number outside the range of double is too small, by the sign of the exponent of
// its first significant digit.
bool is_underflow(std::string_view word) {
  constexpr std::int64_t kHuge = std::int64_t{1} << 60;
  const std::size_t mantissa_end = std::min(word.find_first_of("eE"), word.size());
  const std::string_view mantissa = word.substr(0, mantissa_end);
  const std::size_t point = std::min(mantissa.find('.'), mantissa.size());
  const std::size_t first_digit = mantissa.find_first_of("123456789");
  std::int64_t exponent = 0;
  if (mantissa_end < word.size()) {
    const std::string_view digits = without_plus(word.substr(mantissa_end + 1));
    const auto parsed = from_chars(digits.data(), digits.data() + digits.size(), exponent);
    if (parsed.ec == std::errc::result_out_of_range) return digits[0] == '-';
    exponent = std::clamp<std::int64_t>(exponent, -kHuge, kHuge);
  }
  return static_cast<std::int64_t>(point) - static_cast<std::int64_t>(first_digit) + exponent < 0;
}

}  // namespace

std::string lower_case(std::string_view text) {
  std::string result(text);
  std::transform(result.begin(), result.end(), result.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return result;
}

std::string_view without_plus(std::string_view word) {
  if (word.size() > 1 && word[0] == '+' && word[1] != '-') word.remove_prefix(1);
  return word;
}

std::string in_quotes(std::string_view text) {
  constexpr std::size_t kMaxLength = 40;
  std::string result = "\"";
  for (const char c : text.substr(0, kMaxLength)) result += c >= ' ' && c <= '~' ? c : '?';
  return result + (text.size() > kMaxLength ? "...\"" : "\"");
}

std::string out_of_range_message(std::int64_t index, const char* things, std::int64_t first,
                                 std::size_t count) {
  const std::string message = "the index " + std::to_string(index) + " is out of range; ";
  if (count == 0) return message + "there are no " + things;
  return message + things + " are numbered " + std::to_string(first) + " to " +
         std::to_string(first + static_cast<std::int64_t>(count) - 1);
}

TextReader::TextReader(const std::string& path, std::string text, Syntax syntax,
                       std::int64_t first_line)
    : name_(path == "-" ? "standard input" : path),
      text_(std::move(text)),
      syntax_(syntax),
      line_(first_line) {
  // The UTF-8 byte order mark.
  if (text_.compare(0, 3, "\xEF\xBB\xBF") == 0) position_ = 3;
  if (text_.find('\n') == std::string::npos) std::replace(text_.begin(), text_.end(), '\r', '\n');
}

bool TextReader::skip_continuation() {
  if (!syntax_.continued_lines || text_[position_] != '\\') return false;
  std::size_t next = position_ + 1;
  while (next < text_.size() && is_blank(text_[next])) ++next;
  if (next < text_.size() && text_[next] != '\n') return false;
  line_ += next < text_.size();
  position_ = std::min(next + 1, text_.size());
  return true;
}

bool TextReader::has_word() {
  while (position_ < text_.size()) {
    const char c = text_[position_];
    if (is_blank(c)) {
      ++position_;
    } else if (c == '\n' || (c == syntax_.comment && c != '\0')) {
      return false;
    } else if (!skip_continuation()) {
      return true;
    }
  }
  return false;
}

bool TextReader::next_line() {
  if (!started_) {
    started_ = true;
    if (has_word()) return true;
  }
  for (;;) {
    const std::size_t end = text_.find('\n', position_);
    // The last line ends with the last line break.
    if (end == std::string::npos || end + 1 == text_.size()) {
      position_ = text_.size();
      return false;
    }
    position_ = end + 1;
    ++line_;
    if (has_word()) return true;
  }
}

void TextReader::next_line_of(const char* things, std::int64_t done, std::int64_t declared) {
  if (next_line()) return;
  fail("the file ends after " + std::to_string(done) + " of " + std::to_string(declared) + " " +
       things);
}

bool TextReader::next_word_on_any_line() {
  return (started_ && has_word()) || next_line();
}

void TextReader::next_word_of(const char* things, std::int64_t done, std::int64_t declared) {
  if (next_word_on_any_line()) return;
  fail("the file ends after " + std::to_string(done) + " of " + std::to_string(declared) + " " +
       things);
}

std::string_view TextReader::word() {
  if (!has_word()) return {};
  const std::size_t begin = position_;
  const auto ends_word = [this](char c) {
    return is_blank(c) || c == '\n' || (c == syntax_.comment && c != '\0');
  };
  while (position_ < text_.size() && !ends_word(text_[position_])) {
    if (position_ > begin && text_[position_] == '\\') {
      const std::size_t end = position_;
      if (skip_continuation()) return std::string_view(text_).substr(begin, end - begin);
    }
    ++position_;
  }
  return std::string_view(text_).substr(begin, position_ - begin);
}

std::string_view TextReader::peek() {
  const auto position = position_;
  const auto line = line_;
  const std::string_view result = word();
  position_ = position;
  line_ = line;
  return result;
}

std::string_view TextReader::word_on_any_line(const char* expected) {
  if (!next_word_on_any_line())
    fail(std::string("the file ends where ") + expected + " was expected");
  return word();
}

double TextReader::number_out_of_range(std::string_view word) const {
  if (!is_underflow(word)) fail("the number " + in_quotes(word) + " is too large");
  return word[0] == '-' ? -0.0 : 0.0;
}

double TextReader::number() {
  const std::string_view found = word();
  const double value = number_in(found);
  if (!std::isfinite(value)) fail_expected("a finite number", found);
  return value;
}

double TextReader::any_number() {
  return number_in(word());
}

double TextReader::number_in(std::string_view found) const {
  const std::string_view digits = without_plus(found);
  double value = 0;
  const auto parsed = from_chars(digits.data(), digits.data() + digits.size(), value);
  if (parsed.ec == std::errc::invalid_argument || parsed.ptr != digits.data() + digits.size()) {
    fail_expected("a number", found);
  }
  if (parsed.ec == std::errc::result_out_of_range) return number_out_of_range(digits);
  return value;
}

Vector<3> TextReader::point() {
  Vector<3> result;
  for (double& coordinate : result) coordinate = number();
  return result;
}

std::int64_t TextReader::integer() {
  const std::string_view found = word();
  const std::string_view digits = without_plus(found);
  std::int64_t value = 0;
  const auto parsed = from_chars(digits.data(), digits.data() + digits.size(), value);
  if (parsed.ec == std::errc::invalid_argument || parsed.ptr != digits.data() + digits.size()) {
    fail_expected("an integer", found);
  }
  if (parsed.ec == std::errc::result_out_of_range) {
    fail("the number " + in_quotes(found) + " is too large");
  }
  return value;
}

Index TextReader::count(const char* things, std::size_t bytes_each) {
  const std::int64_t value = integer();
  const std::string declared = std::to_string(value) + " " + things;
  if (value < 0) fail(declared + " are declared; the number cannot be negative");
  if (value > std::numeric_limits<Index>::max()) {
    fail(declared + " are declared, more than this program can handle");
  }
  // The last line may lack its line break.
  if (bytes_each > 0 && static_cast<std::size_t>(value) > (bytes_left() + 1) / bytes_each) {
    fail(declared + " are declared, but the file is too short to hold them");
  }
  return static_cast<Index>(value);
}

Index TextReader::index(const char* things, std::int64_t first, Index count) {
  const std::int64_t value = integer();
  if (value < first || value - first >= count) {
    fail(out_of_range_message(value, things, first, static_cast<std::size_t>(count)));
  }
  return static_cast<Index>(value - first);
}

void TextReader::expect_end_of_line() {
  if (has_word()) fail_expected("the end of the line", word());
}

void TextReader::expect_end_of_file(const std::string& after) {
  if (next_word_on_any_line()) fail_expected("the end of the file after " + after, word());
}

void TextReader::fail_at(std::int64_t line, const std::string& message) const {
  throw InputError(name_ + ":" + std::to_string(line) + ": " + message);
}

void TextReader::fail_expected(const std::string& expected, std::string_view found) const {
  const char* const nothing = bytes_left() > 0 ? "the end of the line" : "the end of the file";
  fail("expected " + expected + ", found " + (found.empty() ? nothing : in_quotes(found)));
}

}  // namespace flbc::io
