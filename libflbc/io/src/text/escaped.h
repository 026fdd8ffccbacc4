// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Text in XML and HTML.
#pragma once

#include <string>

namespace flbc::io {

//! The text with entities in place of markup characters.
inline std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    switch (c) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '"':
        result += "&quot;";
        break;
      default:
        result += c;
    }
  }
  return result;
}

}  // namespace flbc::io
