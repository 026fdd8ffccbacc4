// SPDX-License-Identifier: BSD-3-Clause
// The structure of PLY files: a header of lines that declares elements with typed properties, then
// their values, as words or as bytes.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "model/model_scan.h"

namespace flbc::io {

//! A type of numbers.
struct PlyType {
  const char* name;
  const char* other_name;
  std::uint32_t bytes;
  char kind;  //!< i: signed, u: unsigned, f: floating
};

//! A property of each element: a number or a list of numbers.
struct PlyProperty {
  std::string name{};
  const PlyType* type = nullptr;
  const PlyType* count_type = nullptr;  //!< of lists
};

//! The properties that make a vertex a Gaussian splat.
constexpr const char* kSplatProperties[] = {"x",      "y",       "z",       "f_dc_0", "f_dc_1",
                                            "f_dc_2", "opacity", "rot_0",   "rot_1",  "rot_2",
                                            "rot_3",  "scale_0", "scale_1", "scale_2"};

//! Elements with the same properties.
struct PlyElement {
  std::string name{};
  std::int64_t count = 0;
  std::vector<PlyProperty> properties{};

  //! The place of a property, -1 if there is none.
  int find(const std::string& property) const;
};

//! Parses a file. All errors are InputErrors naming file and line or byte.
class PlyReader {
 public:
  //! Reads the header. Keeps references.
  PlyReader(const std::string& path, const std::string& content);

  const std::vector<PlyElement>& elements() const { return elements_; }
  bool is_text() const { return !is_binary_; }
  bool is_binary_little_endian() const { return is_binary_ && !is_big_endian_; }
  //! The next byte; after construction the first one after the header.
  std::size_t position() const { return position_; }
  bool has_comments() const { return has_comments_; }
  //! Of a comment "TextureFile NAME"; empty if there is none.
  const std::string& texture_file() const { return texture_file_; }

  //! Throws unless the rest of the file can hold this number of elements.
  void check_count(const PlyElement& element) const;

  //! A number and its location.
  struct Number {
    double value;
    NumberPlace place;
  };
  Number number(const PlyType& type);

  //! A number that is an index or a length.
  Index index(const PlyType& type);

  //! The length of a list, limited by the rest of the file.
  Index list_length(const PlyProperty& property);

  [[noreturn]] void fail(const std::string& message) const;

 private:
  std::string header_line();
  void read_header();
  const PlyType* type_of(const std::string& name) const;
  std::size_t bytes_left() const { return content_.size() - position_; }
  Number text_number(const PlyType& type);
  Number binary_number(const PlyType& type);

  const std::string& path_;
  const std::string& content_;
  std::size_t position_ = 0;
  bool is_in_header_ = true;
  char line_end_ = '\n';  // of the header
  bool is_binary_ = false;
  bool is_big_endian_ = false;
  bool has_comments_ = false;
  std::string texture_file_;
  std::vector<PlyElement> elements_;
};

}  // namespace flbc::io
