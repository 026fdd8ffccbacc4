// SPDX-License-Identifier: BSD-3-Clause
#include "text/xml_reader.h"

#include <algorithm>
#include <charconv>

#include "flbc/errors.h"

namespace flbc::io {
namespace {

constexpr std::string_view kBlanks = " \t\r\n";

std::string utf8(std::uint32_t code) {
  const auto byte = [](std::uint32_t bits) { return static_cast<char>(bits); };
  if (code < 0x80) return {byte(code)};
  if (code < 0x800) return {byte(0xc0 | code >> 6), byte(0x80 | (code & 0x3f))};
  if (code < 0x10000) {
    return {byte(0xe0 | code >> 12), byte(0x80 | (code >> 6 & 0x3f)), byte(0x80 | (code & 0x3f))};
  }
  return {byte(0xf0 | code >> 18), byte(0x80 | (code >> 12 & 0x3f)),
          byte(0x80 | (code >> 6 & 0x3f)), byte(0x80 | (code & 0x3f))};
}

}  // namespace

XmlReader::XmlReader(std::string path, std::string content)
    : path_(std::move(path)), content_(std::move(content)) {
}

void XmlReader::fail(const std::string& message) const {
  throw InputError(path_ + ":" + std::to_string(line_) + ": " + message);
}

void XmlReader::move_to(std::size_t position) {
  const char* const content = content_.data();
  line_ += std::count(content + position_, content + position, '\n');
  position_ = position;
}

void XmlReader::skip_past(std::string_view end, const char* what) {
  const std::size_t found = content_.find(end, position_);
  if (found == std::string::npos) fail("the file ends inside " + std::string(what));
  move_to(found + end.size());
}

bool XmlReader::next_tag() {
  for (;;) {
    const std::size_t begin = content_.find('<', position_);
    if (begin == std::string::npos) {
      move_to(content_.size());
      return false;
    }
    move_to(begin);
    if (content_.compare(begin, 4, "<!--") == 0) {
      skip_past("-->", "a comment");
    } else if (content_.compare(begin, 2, "<?") == 0) {
      skip_past("?>", "a processing instruction");
    } else if (content_.compare(begin, 2, "<!") == 0) {
      skip_past(">", "a declaration");
    } else {
      const std::size_t end = find_end_of_tag();
      parse_tag(std::string_view(content_).substr(begin + 1, end - begin - 1));
      move_to(end + 1);
      return true;
    }
  }
}

// A ">" may stand in an attribute.
std::size_t XmlReader::find_end_of_tag() const {
  char quote = '\0';
  for (std::size_t k = position_; k < content_.size(); ++k) {
    const char c = content_[k];
    if (quote == '\0' && c == '>') return k;
    if (quote == '\0' && (c == '"' || c == '\'')) {
      quote = c;
    } else if (c == quote) {
      quote = '\0';
    }
  }
  fail("the file ends inside a tag");
}

void XmlReader::parse_tag(std::string_view tag) {
  is_end_tag_ = !tag.empty() && tag[0] == '/';
  if (is_end_tag_) tag.remove_prefix(1);
  if (!tag.empty() && tag.back() == '/') tag.remove_suffix(1);
  const std::size_t name_end = std::min(tag.find_first_of(kBlanks), tag.size());
  if (name_end == 0) fail("a tag has no name");
  name_ = tag.substr(0, name_end);
  attributes_.clear();
  for (std::size_t k = name_end;;) {
    k = tag.find_first_not_of(kBlanks, k);
    if (k == std::string_view::npos) return;
    const std::size_t equals = tag.find('=', k);
    const std::size_t open =
        equals == std::string_view::npos ? equals : tag.find_first_not_of(kBlanks, equals + 1);
    if (open == std::string_view::npos || (tag[open] != '"' && tag[open] != '\'')) {
      fail("the tag " + in_quotes(name_) + " has an attribute without a value in quotes");
    }
    const std::size_t close = tag.find(tag[open], open + 1);
    if (close == std::string_view::npos) fail("the tag " + in_quotes(name_) + " has an open quote");
    std::string_view key = tag.substr(k, equals - k);
    key = key.substr(0, key.find_last_not_of(kBlanks) + 1);
    attributes_.emplace_back(key, decoded(tag.substr(open + 1, close - open - 1)));
    k = close + 1;
  }
}

std::string XmlReader::attribute(const std::string& name) const {
  for (const auto& [key, value] : attributes_) {
    if (key == name) return value;
  }
  return {};
}

std::string XmlReader::decoded(std::string_view text) const {
  std::string result;
  while (!text.empty()) {
    const std::size_t begin = std::min(text.find('&'), text.size());
    result += text.substr(0, begin);
    text.remove_prefix(begin);
    if (text.empty()) break;
    const std::size_t end = text.find(';');
    if (end == std::string_view::npos) fail("an entity that starts with & has no end");
    result += decoded_entity(text.substr(1, end - 1));
    text.remove_prefix(end + 1);
  }
  return result;
}

std::string XmlReader::decoded_entity(std::string_view entity) const {
  if (entity == "amp") return "&";
  if (entity == "lt") return "<";
  if (entity == "gt") return ">";
  if (entity == "quot") return "\"";
  if (entity == "apos") return "'";
  if (entity.size() > 1 && entity[0] == '#') {
    const bool is_hexadecimal = entity[1] == 'x';
    const std::string_view digits = entity.substr(is_hexadecimal ? 2 : 1);
    const char* const end = digits.data() + digits.size();
    std::uint32_t code = 0;
    const auto parsed = std::from_chars(digits.data(), end, code, is_hexadecimal ? 16 : 10);
    if (parsed.ec == std::errc() && parsed.ptr == end && code > 0 && code < 0x110000) {
      return utf8(code);
    }
  }
  fail("unknown entity " + in_quotes("&" + std::string(entity) + ";"));
}

TextReader XmlReader::text() {
  const std::size_t end = std::min(content_.find('<', position_), content_.size());
  const std::int64_t first_line = line_;
  std::string words = content_.substr(position_, end - position_);
  move_to(end);
  return TextReader(path_, std::move(words), {}, first_line);
}

}  // namespace flbc::io
