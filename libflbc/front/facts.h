// SPDX-License-Identifier: BSD-3-Clause
// Numbers in words, with as many digits as a reader wants.
#pragma once

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>

#include <Eigen/Core>

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

//! The number of digits that two corners of a box need to differ, also far from the origin.
template <class Derived>
int digits_of_box(const Eigen::MatrixBase<Derived>& low, const Eigen::MatrixBase<Derived>& high) {
  constexpr int kUsual = 6, kMost = 17;
  const double size = (high - low).norm();
  const double farthest = std::max(low.cwiseAbs().maxCoeff(), high.cwiseAbs().maxCoeff());
  if (!(size > 0 && farthest > size)) return kUsual;
  return std::min(kMost, kUsual + static_cast<int>(std::log10(farthest / size)));
}

}  // namespace flbc::app
