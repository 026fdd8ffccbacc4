// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! How corners of faces and lines in OBJ files refer to vertices, texture coordinates and normals.
#pragma once

#include <charconv>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <system_error>

#include "flbc/types.h"
#include "text/text_reader.h"

namespace flbc::io {

//! References to a list that may follow in the file, so the range check is at its end. It needs
//! only the largest reference and its line.
class ObjReferences {
 public:
  explicit ObjReferences(const char* things) : things_(things) {}

  //! \param number  from 1, or backwards from the latest of `seen` if negative; 0 = none
  //! \param digits  the number as text, if it may be too large for its type
  //! \return from 0, -1 = none
  Index resolve(const TextReader& reader, std::int64_t number, std::size_t seen,
                std::string_view digits = {}) {
    const std::int64_t index = number >= 0 ? number - 1 : static_cast<std::int64_t>(seen) + number;
    if ((number < 0 && index < 0) || index >= std::numeric_limits<Index>::max()) {
      reader.fail("the index " + (digits.empty() ? std::to_string(number) : in_quotes(digits)) +
                  " is out of range; there are " + std::to_string(seen) + " " + things_ +
                  " before this line");
    }
    if (index > largest_) {
      largest_ = index;
      line_ = reader.line();
    }
    return static_cast<Index>(index);
  }

  void check(const TextReader& reader, std::size_t count) const {
    if (largest_ < static_cast<std::int64_t>(count)) return;
    reader.fail_at(line_, out_of_range_message(largest_ + 1, things_, 1, count));
  }

 private:
  const char* things_;
  std::int64_t largest_ = -1;
  std::int64_t line_ = 1;
};

//! The numbers of "i", "i/t", "i/t/n" or "i//n"; 0 for a missing one.
struct ObjCorner {
  std::int64_t vertex = 0;
  std::int64_t texture_coordinate = 0;
  std::int64_t normal = 0;
};

//! \throws InputError if the word is none of these
inline ObjCorner parse_corner(const TextReader& reader, std::string_view word) {
  ObjCorner corner;
  std::string_view rest = word;
  for (auto* const number : {&corner.vertex, &corner.texture_coordinate, &corner.normal}) {
    const std::size_t slash = rest.find('/');
    const std::string_view digits = rest.substr(0, slash);
    const bool is_vertex = number == &corner.vertex;
    if (is_vertex || !digits.empty()) {
      const char* const end = digits.data() + digits.size();
      const auto [stop, error] = std::from_chars(digits.data(), end, *number);
      const bool is_huge = error == std::errc::result_out_of_range;
      if (stop != end || error == std::errc::invalid_argument || (is_huge && !is_vertex)) break;
      constexpr auto kHuge = std::numeric_limits<std::int64_t>::max();
      if (is_huge) *number = digits[0] == '-' ? -kHuge : kHuge;
    }
    if (slash == std::string_view::npos) return corner;
    rest.remove_prefix(slash + 1);
  }
  reader.fail_expected("a vertex index", word);
}

}  // namespace flbc::io
