// SPDX-License-Identifier: BSD-3-Clause
// Numbers inside of text.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace flbc::draw {

//! The bytes in base64 (RFC 4648, with padding).
std::string to_base64(std::string_view bytes);

template <class Number>
std::string numbers_to_base64(const std::vector<Number>& numbers) {
  const auto* bytes = reinterpret_cast<const char*>(numbers.data());
  return to_base64({bytes, numbers.size() * sizeof(Number)});
}

}  // namespace flbc::draw
