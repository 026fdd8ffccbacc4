// SPDX-License-Identifier: BSD-3-Clause
// The distance of a point from a segment.
#pragma once

#include <algorithm>

#include "flbc/types.h"

namespace flbc {

//! Of p from the segment from a to b, which may be a point.
template <int Dim>
double distance_to_segment(const Vector<Dim>& p, const Vector<Dim>& a, const Vector<Dim>& b) {
  const Vector<Dim> along = b - a;
  const double squared = along.squaredNorm();
  const double t = squared > 0 ? std::clamp((p - a).dot(along) / squared, 0.0, 1.0) : 0.0;
  return (p - a - t * along).norm();
}

}  // namespace flbc
