// SPDX-License-Identifier: BSD-3-Clause
// std::from_chars and std::to_chars of floating-point numbers, also for libraries without them,
// such as libc++ 13, which is that of the web.
#pragma once

#include <charconv>

#ifndef __cpp_lib_to_chars
#include <fast_float/fast_float.h>

#include <cmath>
#include <cstdio>
#include <system_error>
#endif

namespace flbc::io {

#ifdef __cpp_lib_to_chars
using std::from_chars;
using std::to_chars;
#else
template <class Number>
std::from_chars_result from_chars(const char* begin, const char* end, Number& value) {
  if constexpr (!std::is_floating_point_v<Number>) {
    return std::from_chars(begin, end, value);
  } else {
    const auto [stop, error] = fast_float::from_chars(begin, end, value);
    // The library reads too large numbers as infinity.
    const char first = begin == end ? '\0' : begin[*begin == '-' && begin + 1 < end];
    const bool is_too_large = std::isinf(value) && first >= '.' && first <= '9';
    return {stop, is_too_large ? std::errc::result_out_of_range : error};
  }
}

template <class Number>
std::to_chars_result to_chars(char* begin, char* end, Number value) {
  if constexpr (!std::is_floating_point_v<Number>) {
    return std::to_chars(begin, end, value);
  } else {
    int length = 0;
    Number again{};
    for (int digits = 15; digits <= 17; ++digits) {
      length = std::snprintf(begin, static_cast<std::size_t>(end - begin), "%.*g", digits,
                             static_cast<double>(value));
      fast_float::from_chars(begin, begin + length, again);
      if (again == value) break;
    }
    return {begin + length, std::errc()};
  }
}
#endif

}  // namespace flbc::io
