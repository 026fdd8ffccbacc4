// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/vtu_points.h"

#include <charconv>
#include <system_error>

#include <pugixml.hpp>

#include "flbc/errors.h"
#include "text/text_reader.h"

namespace flbc::io {
namespace {

constexpr const char* kTag = "<AppendedData";

class HeaderReader {
 public:
  HeaderReader(const std::string& path, const std::string& start, std::size_t tag)
      : path_(path), end_(start.find('>', tag)) {
    // Bytes after the tag are not XML.
    const auto xml = start.substr(0, end_) + "></AppendedData></VTKFile>";
    const auto parsed =
        document_.load_buffer(xml.data(), xml.size(), pugi::parse_default, pugi::encoding_utf8);
    if (end_ == std::string::npos || !parsed) {
      fail(std::string("the XML is malformed: ") + parsed.description());
    }
    data_ = start.find_first_not_of(" \t\r\n", end_ + 1);
    if (data_ == std::string::npos || start[data_] != '_') {
      fail("the appended data have no \"_\" at their start");
    }
    ++data_;
  }

  std::optional<VtuPoints> read() const {
    const auto file = document_.document_element();
    if (file.name() != std::string("VTKFile")) fail("the first tag must be <VTKFile>");
    const auto piece = file.child("UnstructuredGrid").child("Piece");
    if (!piece) fail("the file has no unstructured grid");
    const auto array = piece.child("Points").child("DataArray");
    if (array.attribute("format").value() != std::string("appended")) return {};
    if (piece.next_sibling("Piece")) fail("the grid has more than one piece; merge them");
    if (file.attribute("compressor")) {
      fail("the data are compressed; save the file without compression");
    }
    require(file.child("AppendedData"), "encoding", "encoding", "raw");
    require(file, "byte_order", "byte order", "LittleEndian");
    if (array.attribute("NumberOfComponents").value() != std::string("3")) {
      fail("points need 3 components");
    }
    VtuPoints points;
    points.count = whole_number(piece, "NumberOfPoints");
    points.block = data_ + static_cast<std::size_t>(whole_number(array, "offset"));
    points.size_width = is_larger(file, "header_type", "header type", "UInt32", "UInt64") ? 8 : 4;
    points.is_double = is_larger(array, "type", "points of type", "Float32", "Float64");
    return points;
  }

 private:
  // Whether an attribute has the second of two values; without it, it has the first.
  bool is_larger(const pugi::xml_node& node, const char* attribute, const std::string& what,
                 const std::string& smaller, const std::string& larger) const {
    const std::string value = node.attribute(attribute).as_string(smaller.c_str());
    if (value == smaller || value == larger) return value == larger;
    fail("the " + what + " " + in_quotes(value) + " is not supported; only " + smaller + " and " +
         larger + " are");
  }

  void require(const pugi::xml_node& node, const char* attribute, const std::string& what,
               const std::string& expected) const {
    const std::string value = node.attribute(attribute).value();
    if (value == expected) return;
    fail("the appended data have the " + what + " " + in_quotes(value) + "; only " +
         in_quotes(expected) + " is supported");
  }

  std::int64_t whole_number(const pugi::xml_node& node, const char* attribute) const {
    const std::string text = node.attribute(attribute).value();
    std::int64_t number = -1;
    const auto parsed = std::from_chars(text.data(), text.data() + text.size(), number);
    if (parsed.ec != std::errc() || parsed.ptr != text.data() + text.size() || number < 0) {
      fail(std::string(attribute) + " " + in_quotes(text) + " is not a number from 0");
    }
    return number;
  }

  [[noreturn]] void fail(const std::string& message) const {
    throw InputError(path_ + ": " + message);
  }

  const std::string& path_;
  std::size_t end_;
  std::size_t data_ = 0;
  pugi::xml_document document_;
};

}  // namespace

std::optional<VtuPoints> find_vtu_points(const std::string& path, const std::string& start) {
  const auto tag = start.find(kTag);
  if (tag == std::string::npos) return {};
  return HeaderReader(path, start, tag).read();
}

}  // namespace flbc::io
