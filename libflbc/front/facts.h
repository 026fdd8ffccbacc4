// SPDX-License-Identifier: BSD-3-Clause
// Numbers in words, with as many digits as a reader wants.
#pragma once

#include <sstream>
#include <string>

namespace flbc::app {

//! Text with three digits of every floating-point number.
class Facts {
 public:
  Facts() { text_.precision(3); }

  template <class Value>
  Facts& operator<<(const Value& value) {
    text_ << value;
    return *this;
  }

  std::string text() const { return text_.str(); }

 private:
  std::ostringstream text_;
};

//! "1, 2, 3"
template <class List>
std::string joined(const List& items) {
  Facts text;
  const char* separator = "";
  for (const auto& item : items) {
    text << separator << item;
    separator = ", ";
  }
  return text.text();
}

}  // namespace flbc::app
