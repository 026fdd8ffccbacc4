// SPDX-License-Identifier: BSD-3-Clause
// Formats numbers, points, and lists for messages.
#pragma once

#include <algorithm>
#include <cstdio>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "flbc/types.h"

namespace flbc {

//! A number with 6 significant digits.
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

//! "control point 7 at (1, 2)".
template <int Dim>
std::string describe_control_point(const PointList<Dim>& points, Index vertex) {
  return "control point " + std::to_string(vertex) + " at " + format_point(points.col(vertex));
}

//! "3 and 4", "3, 4 and 5"; long lists end in "and N more".
inline std::string describe_list(const std::vector<Index>& numbers) {
  constexpr std::size_t kMostShown = 6;
  const std::size_t shown = std::min(numbers.size(), kMostShown);
  std::string text;
  for (std::size_t i = 0; i < shown; ++i) {
    const bool is_last = i + 1 == numbers.size();
    if (i > 0) text += is_last ? " and " : ", ";
    text += std::to_string(numbers[i]);
  }
  if (shown < numbers.size()) text += " and " + std::to_string(numbers.size() - shown) + " more";
  return text;
}

//! Adds a note, if there is one, after "; ".
inline void add_note(std::string& notes, const std::string& note) {
  notes += (notes.empty() || note.empty() ? "" : "; ") + note;
}

}  // namespace flbc
