// SPDX-License-Identifier: BSD-3-Clause
// PLY: a header of lines that declares elements with typed properties, then their values, as words
// or as bytes.
#include "openmesh_bindings/ply_file.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>
#include <sstream>
#include <string_view>
#include <vector>

#include "flbc/errors.h"
#include "flbc/io/files.h"

namespace flbc::openmesh {
namespace {

struct Type {
  const char* name;
  const char* other_name;
  std::size_t bytes;
  char kind;  // i: signed, u: unsigned, f: floating
};
constexpr Type kTypes[] = {{"char", "int8", 1, 'i'},     {"uchar", "uint8", 1, 'u'},
                           {"short", "int16", 2, 'i'},   {"ushort", "uint16", 2, 'u'},
                           {"int", "int32", 4, 'i'},     {"uint", "uint32", 4, 'u'},
                           {"float", "float32", 4, 'f'}, {"double", "float64", 8, 'f'}};

struct Property {
  std::string name;
  const Type* type = nullptr;
  const Type* count_type = nullptr;  // of lists
};

struct Element {
  std::string name;
  std::int64_t count = 0;
  std::vector<Property> properties;
};

class PlyReader {
 public:
  explicit PlyReader(const std::string& path) : path_(path), content_(io::read_file(path)) {}

  io::PolygonSoup read() {
    read_header();
    for (const Element& element : elements_) read_element(element);
    for (std::size_t f = 0; f < soup_.polygons.size(); ++f) check_polygon(f);
    return std::move(soup_);
  }

 private:
  [[noreturn]] void fail(const std::string& message) const {
    const auto begin = content_.begin();
    const bool is_text = !is_binary_ || position_ < body_;
    throw InputError(
        path_ +
        (is_text
             ? ":" + std::to_string(1 + std::count(begin, begin + std::ptrdiff_t(position_), '\n'))
             : ": at byte " + std::to_string(position_)) +
        ": " + message);
  }

  std::istringstream header_line() {
    const std::size_t end = content_.find('\n', position_);
    if (end == std::string::npos) fail("the header of the PLY file has no end");
    std::istringstream line(content_.substr(position_, end - position_));
    position_ = end + 1;
    return line;
  }

  const Type* type_of(const std::string& name) const {
    for (const Type& type : kTypes) {
      if (name == type.name || name == type.other_name) return &type;
    }
    fail("the header has a property of unknown type");
  }

  void read_header() {
    std::string word;
    if (!(header_line() >> word) || word != "ply") fail("not a PLY file");
    while (word != "end_header") {
      auto line = header_line();
      word.clear();
      line >> word;
      if (word == "format") {
        line >> word;
        if (word != "ascii" && word.substr(0, 7) != "binary_") fail("unknown format of PLY file");
        is_binary_ = word != "ascii";
        is_big_endian_ = word == "binary_big_endian";
      } else if (word == "element") {
        Element element;
        if (!(line >> element.name >> element.count) || element.count < 0) {
          fail("an element needs a name and a number that is not negative");
        }
        elements_.push_back(element);
      } else if (word == "property") {
        if (elements_.empty()) fail("a property belongs to no element");
        elements_.back().properties.push_back(read_property(line));
      }
    }
    body_ = position_;
  }

  Property read_property(std::istringstream& line) const {
    Property property;
    std::string word;
    line >> word;
    if (word == "list") {
      line >> word;
      property.count_type = type_of(word);
      line >> word;
    }
    property.type = type_of(word);
    if (!(line >> property.name)) fail("a property has no name");
    return property;
  }

  void read_element(const Element& element) {
    const std::string declared =
        std::to_string(element.count) + " elements \"" + element.name + "\" are declared, ";
    if (element.count > std::numeric_limits<Index>::max()) {
      fail(declared + "more than this program can handle");
    }
    // Each takes a byte at least, so that a damaged number does not claim all memory.
    if (element.properties.empty() ||
        static_cast<std::size_t>(element.count) > content_.size() - position_) {
      if (element.count > 0) fail(declared + "but the file is too short to hold them");
    }
    for (std::int64_t k = 0; k < element.count; ++k) {
      if (element.name == "vertex") soup_.points.emplace_back(Vector<3>::Zero());
      for (const Property& property : element.properties) read_value(element, property);
      if (element.name == "vertex" && !soup_.points.back().allFinite()) {
        fail("vertex " + std::to_string(k) + " is not finite");
      }
    }
  }

  void read_value(const Element& element, const Property& property) {
    if (!property.count_type) {
      const double value = number(*property.type);
      const std::size_t axis = std::string_view("xyz").find(property.name);
      if (element.name == "vertex" && property.name.size() == 1 && axis < 3) {
        soup_.points.back()[static_cast<Eigen::Index>(axis)] = value;
      }
      return;
    }
    const auto count = static_cast<std::size_t>(index(*property.count_type));
    if (count > content_.size() - position_) fail("a list is longer than the rest of the file");
    const bool is_polygon = element.name == "face" &&
                            (property.name == "vertex_indices" || property.name == "vertex_index");
    if (is_polygon) soup_.polygons.emplace_back();
    for (std::size_t k = 0; k < count; ++k) {
      if (is_polygon) {
        soup_.polygons.back().push_back(index(*property.type));
      } else {
        number(*property.type);
      }
    }
  }

  Index index(const Type& type) {
    const double value = number(type);
    if (!(value >= 0 && value <= std::numeric_limits<Index>::max()) || value != std::floor(value)) {
      fail("expected an index or a length");
    }
    return static_cast<Index>(value);
  }

  double number(const Type& type) { return is_binary_ ? binary_number(type) : text_number(); }

  double text_number() {
    constexpr const char* kBlanks = " \t\r\n";
    position_ = std::min(content_.find_first_not_of(kBlanks, position_), content_.size());
    const std::size_t end = std::min(content_.find_first_of(kBlanks, position_), content_.size());
    if (end == position_) fail("the file ends where a number was expected");
    double value = 0;
    const auto parsed = std::from_chars(content_.data() + position_, content_.data() + end, value);
    if (parsed.ec != std::errc() || parsed.ptr != content_.data() + end) fail("expected a number");
    position_ = end;
    return value;
  }

  double binary_number(const Type& type) {
    if (content_.size() - position_ < type.bytes) fail("the file ends within its numbers");
    unsigned char bytes[8];
    std::memcpy(bytes, content_.data() + position_, type.bytes);
    position_ += type.bytes;
    if (is_big_endian_) std::reverse(bytes, bytes + type.bytes);
    if (type.kind == 'f' && type.bytes == 4) return as<float>(bytes);
    if (type.kind == 'f') return as<double>(bytes);
    if (type.bytes == 4)
      return type.kind == 'i' ? as<std::int32_t>(bytes) : as<std::uint32_t>(bytes);
    if (type.bytes == 2)
      return type.kind == 'i' ? as<std::int16_t>(bytes) : as<std::uint16_t>(bytes);
    return type.kind == 'i' ? as<std::int8_t>(bytes) : as<std::uint8_t>(bytes);
  }

  template <class T>
  static double as(const unsigned char* bytes) {
    T value;
    std::memcpy(&value, bytes, sizeof value);
    return static_cast<double>(value);
  }

  void check_polygon(std::size_t f) const {
    const auto& polygon = soup_.polygons[f];
    const std::string name = path_ + ": face " + std::to_string(f);
    if (polygon.size() < 3) throw InputError(name + " has fewer than 3 vertices");
    const Index largest = *std::max_element(polygon.begin(), polygon.end());
    if (static_cast<std::size_t>(largest) >= soup_.points.size()) {
      throw InputError(name + " names vertex " + std::to_string(largest) + ", but there are " +
                       std::to_string(soup_.points.size()) + " vertices");
    }
  }

  std::string path_;
  std::string content_;
  std::size_t position_ = 0;
  std::size_t body_ = std::numeric_limits<std::size_t>::max();  // where the header ends
  bool is_binary_ = false;
  bool is_big_endian_ = false;
  std::vector<Element> elements_;
  io::PolygonSoup soup_;
};

}  // namespace

io::PolygonSoup read_ply(const std::string& path) {
  return PlyReader(path).read();
}

}  // namespace flbc::openmesh
