// SPDX-License-Identifier: BSD-3-Clause
// Shared input and output of numbers in .om files. Sizes are checked against the stream before
// allocation, so damaged files cause an error.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <istream>
#include <limits>
#include <optional>
#include <ostream>
#include <string>

#include "flbc/errors.h"

namespace flbc::openmesh {

using Count = std::uint64_t;

// .om files store the size of a property in 32 bits.
constexpr Count kMostStoredBytes = std::numeric_limits<std::uint32_t>::max();

[[noreturn]] inline void refuse_stored(const std::string& name, const std::string& why) {
  throw InputError("property '" + name + "' cannot be read: " + why);
}

//! \throws IoError if a property exceeds the limit of .om files
inline void require_storable(const std::string& name, std::size_t bytes) {
  if (bytes <= kMostStoredBytes) return;
  throw IoError("property '" + name + "' needs " + std::to_string(bytes) +
                " bytes, but .om files store at most " + std::to_string(kMostStoredBytes) +
                " per property");
}

template <class Number>
void reverse_bytes(Number& number) {
  auto* bytes = reinterpret_cast<char*>(&number);
  std::reverse(bytes, bytes + sizeof number);
}

template <class Number>
void write_numbers(std::ostream& out, const Number* numbers, std::size_t count, bool swap) {
  if (!swap) {
    out.write(reinterpret_cast<const char*>(numbers),
              static_cast<std::streamsize>(count * sizeof(Number)));
    return;
  }
  for (std::size_t i = 0; i < count; ++i) {
    Number number = numbers[i];
    reverse_bytes(number);
    out.write(reinterpret_cast<const char*>(&number), sizeof number);
  }
}

template <class Number>
bool read_numbers(std::istream& in, Number* numbers, std::size_t count, bool swap) {
  in.read(reinterpret_cast<char*>(numbers), static_cast<std::streamsize>(count * sizeof(Number)));
  if (swap) std::for_each(numbers, numbers + count, reverse_bytes<Number>);
  return in.good();
}

using Magic = std::array<char, 8>;  // names the kind of a property

template <std::size_t N>
void write_header(std::ostream& out, bool swap, const Magic& magic,
                  const std::array<Count, N>& fields) {
  write_numbers(out, magic.data(), magic.size(), false);
  write_numbers(out, fields.data(), fields.size(), swap);
}

template <std::size_t N>
std::array<Count, N> read_header(std::istream& in, bool swap, const std::string& name,
                                 const Magic& magic) {
  Magic found{};
  std::array<Count, N> fields{};
  if (!read_numbers(in, found.data(), found.size(), false)) {
    refuse_stored(name, "the file ends before the property");
  }
  if (found != magic) {
    refuse_stored(name, "the file has a property of another type under this name");
  }
  if (!read_numbers(in, fields.data(), fields.size(), swap)) {
    refuse_stored(name, "the file ends within the property");
  }
  return fields;
}

inline void require_elements(const std::string& name, Count found, Count expected) {
  if (found == expected) return;
  refuse_stored(name, "the file has it for " + std::to_string(found) +
                          " elements, but the mesh has " + std::to_string(expected));
}

//! The product, saturated at the maximum.
inline Count product(Count a, Count b) {
  constexpr Count kMost = std::numeric_limits<Count>::max();
  return b > 0 && a > kMost / b ? kMost : a * b;
}

//! No value if the stream is not seekable.
inline std::optional<Count> bytes_left(std::istream& in) {
  const auto here = in.tellg();
  if (here < 0) return std::nullopt;
  in.seekg(0, std::ios::end);
  const auto end = in.tellg();
  in.seekg(here);
  return static_cast<Count>(end - here);
}

}  // namespace flbc::openmesh
