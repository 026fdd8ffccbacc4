// SPDX-License-Identifier: BSD-3-Clause
// Limits for the size of a cage or model and for its distance from the origin.
#pragma once

#include <string>

#include "base/messages.h"
#include "flbc/bounding_box.h"
#include "flbc/types.h"

namespace flbc {

//! What is wrong with the extent of points, which must be finite; empty: nothing. \param name  of
//! what they belong to \param first  name of the first of them
template <int Dim>
std::string extent_defect(const PointList<Dim>& points, const std::string& name,
                          const std::string& first) {
  // Meshers multiply up to five lengths; the product must not overflow or underflow.
  constexpr double kSmallestSize = 1e-30;
  constexpr double kLargestSize = 1e30;
  // At a larger distance from the origin, relative to size, rounded coordinates violate the
  // tolerance of reproduction.
  constexpr double kFarthest = 2e8;
  const double size = points.cols() > 0 ? bounding_box_diagonal<Dim>(points) : 0;
  if (!(size >= kSmallestSize && size <= kLargestSize)) {
    return "the " + name + " size of " + format_number(size) +
           " is out of range; it must be from " + format_number(kSmallestSize) + " to " +
           format_number(kLargestSize) + (size > 0 ? "; use another unit of length" : "");
  }
  if (points.cwiseAbs().maxCoeff() > kFarthest * size) {
    return "the " + name + " is too far from the origin for its size of " + format_number(size) +
           ", with " + first + " at " + format_point(points.col(0)) +
           ": its coordinates have too few digits; move it to the origin";
  }
  return {};
}

}  // namespace flbc
