// SPDX-License-Identifier: BSD-3-Clause
#include "weights/npy_header.h"

#include <algorithm>
#include <charconv>
#include <string_view>
#include <system_error>

#include "flbc/errors.h"
#include "text/text_reader.h"

namespace flbc::io {
namespace {

constexpr std::string_view kMagic = "\x93NUMPY";

// Parses the Python literals of a header.
class HeaderParser {
 public:
  HeaderParser(const std::string& path, std::string_view content, std::size_t begin)
      : path_(path), content_(content), position_(begin) {}

  void parse(NpyHeader& header) {
    bool has_type = false, has_order = false, has_shape = false;
    expect('{');
    while (!accept('}')) {
      const std::size_t key_position = position_;
      const std::string key = string();
      expect(':');
      if (key == "descr") {
        header.type = type();
        has_type = true;
      } else if (key == "fortran_order") {
        header.fortran_order = boolean();
        has_order = true;
      } else if (key == "shape") {
        header.shape = tuple();
        has_shape = true;
      } else {
        fail(key_position, "the header has an unknown key " + in_quotes(key));
      }
      if (!accept(',')) {
        expect('}');
        break;
      }
    }
    if (next() != '\0') fail(position_, "expected the end of the header");
    if (!has_type) fail(position_, "the header has no 'descr'");
    if (!has_order) fail(position_, "the header has no 'fortran_order'");
    if (!has_shape) fail(position_, "the header has no 'shape'");
  }

  [[noreturn]] void fail(std::size_t byte, const std::string& message) const {
    throw InputError(path_ + ": at byte " + std::to_string(byte) + ": " + message);
  }

 private:
  // The next non-blank character; NUL at the end.
  char next() {
    position_ = std::min(content_.find_first_not_of(" \t\r\n", position_), content_.size());
    return position_ < content_.size() ? content_[position_] : '\0';
  }

  bool accept(char c) {
    if (next() != c) return false;
    ++position_;
    return true;
  }

  void expect(char c) {
    if (!accept(c)) {
      fail(position_, "expected '" + std::string(1, c) + "' in the header, found " + rest());
    }
  }

  std::string rest() const {
    return position_ < content_.size() ? in_quotes(content_.substr(position_, 12)) : "its end";
  }

  std::string string() {
    const char quote = next();
    if (quote != '\'' && quote != '"') fail(position_, "expected a string, found " + rest());
    const std::size_t begin = position_ + 1;
    const std::size_t end = content_.find(quote, begin);
    if (end == std::string_view::npos) fail(position_, "the header has a string without end");
    position_ = end + 1;
    return std::string(content_.substr(begin, end - begin));
  }

  std::string type() {
    if (next() == '[') fail(position_, "the array has structured elements; plain numbers expected");
    return string();
  }

  bool boolean() {
    next();
    for (const std::string_view word : {"True", "False"}) {
      if (content_.substr(position_, word.size()) != word) continue;
      position_ += word.size();
      return word == "True";
    }
    fail(position_, "expected True or False, found " + rest());
  }

  std::vector<std::int64_t> tuple() {
    std::vector<std::int64_t> values;
    expect('(');
    while (!accept(')')) {
      next();
      std::int64_t value = 0;
      const char* const begin = content_.data() + position_;
      const auto parsed = std::from_chars(begin, content_.data() + content_.size(), value);
      if (parsed.ec != std::errc() || value < 0) {
        fail(position_, "expected a number of elements, found " + rest());
      }
      position_ += static_cast<std::size_t>(parsed.ptr - begin);
      accept('L');  // Python 2 wrote long integers this way
      values.push_back(value);
      if (!accept(',')) {
        expect(')');
        break;
      }
    }
    return values;
  }

  const std::string& path_;
  std::string_view content_;
  std::size_t position_;
};

}  // namespace

NpyHeader read_npy_header(const std::string& path, const std::string& content) {
  const HeaderParser start(path, content, 0);
  if (content.compare(0, kMagic.size(), kMagic) != 0) start.fail(0, "not a NumPy .npy file");
  const auto byte = [&](std::size_t k) -> std::size_t {
    if (k >= content.size()) start.fail(content.size(), "the file ends inside its header");
    return static_cast<unsigned char>(content[k]);
  };
  const std::size_t version = byte(6);
  if (version < 1 || version > 3) {
    start.fail(6, "version " + std::to_string(version) + " of the format is not supported");
  }
  const std::size_t length_bytes = version == 1 ? 2 : 4;
  std::size_t length = 0;
  for (std::size_t k = 0; k < length_bytes; ++k) length |= byte(8 + k) << (8 * k);

  NpyHeader header;
  header.size = 8 + length_bytes + length;
  if (header.size > content.size()) {
    start.fail(content.size(), "the file ends inside its header");
  }
  const std::string_view text(content.data(), header.size);
  HeaderParser(path, text, 8 + length_bytes).parse(header);
  return header;
}

}  // namespace flbc::io
