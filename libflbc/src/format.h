// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Small pieces of text for error messages.
#pragma once

#include <cstdio>
#include <string>

#include <Eigen/Core>

namespace flbc {

//! A number as a user would write it: 6 significant digits.
inline std::string format_number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", value);
  return text;
}

//! "(x, y)" or "(x, y, z)".
template <class Derived>
std::string format_point(const Eigen::MatrixBase<Derived>& point) {
  std::string text = "(";
  for (Eigen::Index k = 0; k < point.size(); ++k) {
    text += (k > 0 ? ", " : "") + format_number(point[k]);
  }
  return text + ")";
}

}  // namespace flbc
