// SPDX-License-Identifier: BSD-3-Clause
#include "model/ply_reader.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include "flbc/errors.h"
#include "text/bytes.h"
#include "text/float_chars.h"
#include "text/text_reader.h"

namespace flbc::io {
namespace {

constexpr PlyType kTypes[] = {
    {"char", "int8", 1, 'i'},   {"uchar", "uint8", 1, 'u'},   {"bool", "bool", 1, 'u'},
    {"short", "int16", 2, 'i'}, {"ushort", "uint16", 2, 'u'}, {"int", "int32", 4, 'i'},
    {"uint", "uint32", 4, 'u'}, {"float", "float32", 4, 'f'}, {"double", "float64", 8, 'f'}};

}  // namespace

int PlyElement::find(const std::string& property) const {
  for (std::size_t k = 0; k < properties.size(); ++k) {
    if (properties[k].name == property) return static_cast<int>(k);
  }
  return -1;
}

PlyReader::PlyReader(const std::string& path, const std::string& content)
    : path_(path), content_(content) {
  read_header();
  is_in_header_ = false;
}

void PlyReader::fail(const std::string& message) const {
  std::string place = ": at byte " + std::to_string(position_);
  if (is_in_header_ || !is_binary_) {
    const auto end = content_.begin() + static_cast<std::ptrdiff_t>(position_);
    place = ":" + std::to_string(1 + std::count(content_.begin(), end, line_end_));
  }
  throw InputError(path_ + place + ": " + message);
}

std::string PlyReader::header_line() {
  const std::size_t end = content_.find(line_end_, position_);
  if (end == std::string::npos) fail("the header of the PLY file has no end");
  return content_.substr(position_, end - position_);
}

const PlyType* PlyReader::type_of(const std::string& name) const {
  for (const PlyType& type : kTypes) {
    if (name == type.name || name == type.other_name) return &type;
  }
  fail("the type " + in_quotes(name) + " is unknown");
}

void PlyReader::read_header() {
  std::string word;
  if (content_.compare(0, 4, "ply\r") == 0 && content_.compare(4, 1, "\n") != 0) line_end_ = '\r';
  for (bool is_first = true; word != "end_header"; is_first = false) {
    const std::string text = header_line();
    std::istringstream line(text);
    word.clear();
    line >> word;
    if (is_first && word != "ply") fail("not a PLY file");
    if (word == "format") {
      line >> word;
      if (word != "ascii" && word.substr(0, 7) != "binary_") {
        fail("the format " + in_quotes(word) + " is unknown");
      }
      is_binary_ = word != "ascii";
      is_big_endian_ = word == "binary_big_endian";
    } else if (word == "comment" || word == "obj_info") {
      has_comments_ = true;
      std::string name;
      if (word == "comment" && line >> word && word == "TextureFile" &&
          std::getline(line >> std::ws, name)) {
        texture_file_ = name.substr(0, name.find_last_not_of(" \r") + 1);
      }
      word = "comment";
    } else if (word == "element") {
      PlyElement element;
      if (!(line >> element.name >> element.count) || element.count < 0) {
        fail("an element needs a name and a number that is not negative");
      }
      elements_.push_back(element);
    } else if (word == "property") {
      if (elements_.empty()) fail("a property belongs to no element");
      PlyProperty property;
      line >> word;
      if (word == "list") {
        line >> word;
        property.count_type = type_of(word);
        line >> word;
      }
      property.type = type_of(word);
      if (!(line >> property.name)) fail("a property has no name");
      elements_.back().properties.push_back(property);
    }
    position_ += text.size() + 1;
  }
}

void PlyReader::check_count(const PlyElement& element) const {
  const std::string declared =
      std::to_string(element.count) + " elements " + in_quotes(element.name) + " are declared, ";
  if (element.count > std::numeric_limits<Index>::max()) {
    fail(declared + "more than this program can handle");
  }
  // Each takes at least one byte, so a damaged count cannot exhaust memory.
  const bool fits =
      !element.properties.empty() && static_cast<std::size_t>(element.count) <= bytes_left();
  if (!fits && element.count > 0) fail(declared + "but the file is too short to hold them");
}

Index PlyReader::index(const PlyType& type) {
  const double value = number(type).value;
  if (!(value >= 0 && value <= std::numeric_limits<Index>::max()) || value != std::floor(value)) {
    fail("expected an index or a length");
  }
  return static_cast<Index>(value);
}

Index PlyReader::list_length(const PlyProperty& property) {
  const Index length = index(*property.count_type);
  if (static_cast<std::size_t>(length) > bytes_left()) {
    fail("a list is longer than the rest of the file");
  }
  return length;
}

PlyReader::Number PlyReader::number(const PlyType& type) {
  return is_binary_ ? binary_number(type) : text_number(type);
}

PlyReader::Number PlyReader::text_number(const PlyType& type) {
  constexpr const char* kBlanks = " \t\r\n";
  position_ = std::min(content_.find_first_not_of(kBlanks, position_), content_.size());
  const std::size_t end = std::min(content_.find_first_of(kBlanks, position_), content_.size());
  if (end == position_) fail("the file ends where a number was expected");
  const auto word = std::string_view(content_).substr(position_, end - position_);
  const auto digits = without_plus(word);
  double value = 0;
  const auto parsed = from_chars(digits.data(), digits.data() + digits.size(), value);
  if (parsed.ec != std::errc() || parsed.ptr != digits.data() + digits.size()) {
    fail("expected a number, found " + in_quotes(word));
  }
  const NumberPlace place{position_, static_cast<std::uint32_t>(end - position_),
                          type.kind == 'f' ? NumberForm::kText : NumberForm::kInteger};
  position_ = end;
  return {value, place};
}

PlyReader::Number PlyReader::binary_number(const PlyType& type) {
  if (bytes_left() < type.bytes) fail("the file ends within its numbers");
  std::string bytes(content_, position_, type.bytes);
  if (is_big_endian_) std::reverse(bytes.begin(), bytes.end());
  const auto big = [this](NumberForm little_endian, NumberForm big_endian) {
    return is_big_endian_ ? big_endian : little_endian;
  };
  const NumberForm form = type.kind != 'f'  ? NumberForm::kInteger
                          : type.bytes == 4 ? big(NumberForm::kFloat, NumberForm::kBigFloat)
                                            : big(NumberForm::kDouble, NumberForm::kBigDouble);
  const NumberPlace place{position_, type.bytes, form};
  position_ += type.bytes;
  return {decode_number(bytes.data(), type.bytes, type.kind == 'f', type.kind == 'i'), place};
}

}  // namespace flbc::io
