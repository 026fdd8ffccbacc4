// SPDX-License-Identifier: BSD-3-Clause
// Colors of glTF are linear; those of pages and of most other files are sRGB.
#pragma once

#include <cmath>

namespace flbc::io {

inline double to_srgb(double linear) {
  return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
}

inline double to_linear(double srgb) {
  return srgb <= 0.04045 ? srgb / 12.92 : std::pow((srgb + 0.055) / 1.055, 2.4);
}

}  // namespace flbc::io
