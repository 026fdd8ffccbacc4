// SPDX-License-Identifier: BSD-3-Clause
#include "front/base64.h"

#include <algorithm>

namespace flbc::draw {
namespace {

constexpr char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

// Up to three bytes as four digits. \param count  of bytes that there are, at least 1
void append_group(const char* bytes, std::size_t count, std::string& text) {
  unsigned group = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    group = group << 8 | (k < count ? static_cast<unsigned char>(bytes[k]) : 0U);
  }
  for (std::size_t k = 0; k < 4; ++k) {
    text += k <= count ? kDigits[group >> (18 - 6 * k) & 63U] : '=';
  }
}

}  // namespace

std::string to_base64(std::string_view bytes) {
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t k = 0; k < bytes.size(); k += 3) {
    append_group(bytes.data() + k, std::min<std::size_t>(3, bytes.size() - k), text);
  }
  return text;
}

}  // namespace flbc::draw
