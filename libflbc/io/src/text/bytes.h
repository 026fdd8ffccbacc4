// SPDX-License-Identifier: BSD-3-Clause
// Numbers in binary files, which need not be aligned.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>

namespace flbc::io {

template <class Number>
Number number_at(const char* bytes) {
  Number number;
  std::memcpy(static_cast<void*>(&number), bytes, sizeof number);
  return number;
}

template <class Number>
void put_number(Number number, char* bytes) {
  std::memcpy(bytes, &number, sizeof number);
}

//! A number whose type is only known from a header. \param size  bytes: 4 or 8 if floating,
//! otherwise 1, 2, 4, or 8
inline double decode_number(const char* bytes, std::size_t size, bool is_floating, bool is_signed) {
  if (is_floating) return size == 4 ? number_at<float>(bytes) : number_at<double>(bytes);
  switch (size) {
    case 1:
      return is_signed ? number_at<std::int8_t>(bytes) : number_at<std::uint8_t>(bytes);
    case 2:
      return is_signed ? number_at<std::int16_t>(bytes) : number_at<std::uint16_t>(bytes);
    case 4:
      return is_signed ? number_at<std::int32_t>(bytes) : number_at<std::uint32_t>(bytes);
    default:
      return static_cast<double>(number_at<std::int64_t>(bytes));
  }
}

}  // namespace flbc::io
