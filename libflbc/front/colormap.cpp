// SPDX-License-Identifier: BSD-3-Clause
#include "front/colormap.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace flbc::draw {
namespace {

constexpr Color from_bytes(int r, int g, int b) {
  return {static_cast<float>(r) / 255, static_cast<float>(g) / 255, static_cast<float>(b) / 255};
}

// Colors at 0, 0.1, ..., 1, chosen in CIE LCh: the lightness L falls at every step from 93 to 22
// while the hue turns from green (150 degrees) to blue (292 degrees).
constexpr std::array<Color, 11> kTable = {
    from_bytes(216, 241, 221), from_bytes(178, 227, 201), from_bytes(135, 212, 186),
    from_bytes(89, 195, 178),  from_bytes(40, 177, 173),  from_bytes(0, 159, 169),
    from_bytes(0, 139, 173),   from_bytes(0, 117, 169),   from_bytes(0, 94, 155),
    from_bytes(0, 71, 136),    from_bytes(23, 48, 114)};

constexpr Color kZero = from_bytes(248, 248, 249);
constexpr Color kNegative = from_bytes(253, 205, 150);
constexpr Color kVeryNegative = from_bytes(190, 75, 10);
constexpr Color kAboveOne = from_bytes(255, 120, 225);
constexpr Color kFarAboveOne = from_bytes(235, 0, 170);

// The cubic that passes through b and c with the slopes of their neighbors' connections: it avoids
// the bands that the eye sees where a linear scale has kinks.
float cubic(float a, float b, float c, float d, float t) {
  const float slope_b = (c - a) / 2;
  const float slope_c = (d - b) / 2;
  const float bend2 = 3 * (c - b) - 2 * slope_b - slope_c;
  const float bend3 = 2 * (b - c) + slope_b + slope_c;
  return std::clamp(b + t * (slope_b + t * (bend2 + t * bend3)), 0.0F, 1.0F);
}

Color smooth_color(double weight) {
  constexpr int kIntervals = static_cast<int>(kTable.size()) - 1;
  const double position = std::clamp(weight, 0.0, 1.0) * kIntervals;
  const int i = std::min(static_cast<int>(position), kIntervals - 1);
  const auto t = static_cast<float>(position - i);
  const Color& a = kTable[std::max(i - 1, 0)];
  const Color& b = kTable[i];
  const Color& c = kTable[i + 1];
  const Color& d = kTable[std::min(i + 2, kIntervals)];
  return {cubic(a.r, b.r, c.r, d.r, t), cubic(a.g, b.g, c.g, d.g, t), cubic(a.b, b.b, c.b, d.b, t)};
}

// A defect of 0.1 or more has the full color; the root makes small ones visible.
Color defect_color(Color slight, Color severe, double excess) {
  return mix(slight, severe, static_cast<float>(std::sqrt(std::min(1.0, excess / 0.1))));
}

}  // namespace

Color weight_color(double weight) {
  if (std::abs(weight) <= kWeightTolerance) return kZero;
  if (weight < -kWeightTolerance) return defect_color(kNegative, kVeryNegative, -weight);
  if (weight > 1 + kWeightTolerance) return defect_color(kAboveOne, kFarAboveOne, weight - 1);
  return smooth_color(weight);
}

}  // namespace flbc::draw
