// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! The distance of one corner of a triangle from those of the others.
#pragma once

#include <algorithm>
#include <cmath>

namespace flbc::distance {

//! No distance.
constexpr float kNone = -1;

//! Rays along a side common to two simplices must not be lost between them by rounding: so much
//! may they miss, relative to what decides about them.
constexpr float kSlack = 1e-4f;

//! The shape of a triangle, shared by all sources.
struct Triangle {
  float lengths2[3];  //!< squared lengths of the sides opposite to the corners
  float area;         //!< of the parallelogram
};

//! The distance of `corner` from a source beyond the opposite side, in the triangle's plane, with
//! the distances `first` and `second` from the corners that follow it in turn. The difference of
//! their squares tells where along that side the source lies, and Pythagoras how far from it.
//! \return kNone if that is not below `limit` or the ray does not cross that side
inline float distance_through(const Triangle& triangle, int corner, float first, float second,
                              float limit) {
  const int one = corner == 2 ? 0 : corner + 1;
  const int two = corner == 0 ? 2 : corner - 1;
  // Products with the side, whose origin is in the first corner.
  const float side2 = triangle.lengths2[corner];
  const float leg2 = triangle.lengths2[two];
  const float source = 0.5f * (side2 - (second - first) * (second + first));
  const float apex = 0.5f * (side2 + leg2 - triangle.lengths2[one]);
  // Heights times the length of the side.
  const float height2 = first * first * side2 - source * source;
  if (!(height2 >= 0)) return kNone;
  const float height = std::sqrt(height2);
  const float whole = height + triangle.area;
  // How much the squared distance exceeds the smaller one given, times side2.
  const float nearest = std::min(first, second);
  const float gain = side2 * ((first - nearest) * (first + nearest) + leg2) -
                     2 * (source * apex - height * triangle.area);
  if (!(gain < side2 * (limit - nearest) * (limit + nearest))) return kNone;
  // Where the ray crosses the side: shares of the corners times side2 * whole.
  const float share = height * apex + triangle.area * source;
  const float least = std::min(share, side2 * whole - share);
  const float slack = kSlack * std::max(whole, gain / triangle.area - whole);
  if (least < -side2 * slack) return kNone;
  return std::sqrt(std::max(0.f, nearest * nearest + gain / side2));
}

}  // namespace flbc::distance
