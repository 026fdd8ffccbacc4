// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Which samples of a grid lie in a triangle.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "draw/primitives.h"

namespace flbc::draw {
namespace raster {

// Corners are rounded to this fraction of a sample, so that all decisions are exact in integers.
constexpr std::int64_t kSubsteps = 256;

// Beyond this many samples the products of coordinates would overflow.
constexpr double kLargestCoordinate = 4e6;

struct GridPoint {
  std::int64_t x;
  std::int64_t y;
};

inline GridPoint to_grid(const Vector<2>& p) {
  return {std::llround(p.x() * static_cast<double>(kSubsteps)),
          std::llround(p.y() * static_cast<double>(kSubsteps))};
}

// Twice the area to the left of a -> b as seen from p; a sample belongs to the side where `value`
// is >= `threshold`. A sample exactly on an edge belongs to one of its two triangles, as if all
// samples were shifted by an infinitesimal amount.
struct EdgeFunction {
  std::int64_t dx, dy, offset, threshold;

  EdgeFunction(GridPoint a, GridPoint b)
      : dx(b.x - a.x),
        dy(b.y - a.y),
        offset(dy * a.x - dx * a.y),
        threshold(dy > 0 || (dy == 0 && dx < 0) ? 0 : 1) {}

  std::int64_t value(std::int64_t x, std::int64_t y) const { return dx * y - dy * x + offset; }
};

inline std::int64_t floor_divide(std::int64_t a, std::int64_t b) {
  const std::int64_t quotient = a / b;
  return a % b != 0 && (a < 0) != (b < 0) ? quotient - 1 : quotient;
}

inline std::int64_t ceil_divide(std::int64_t a, std::int64_t b) {
  return -floor_divide(-a, b);
}

// Narrows [first, last] to the samples of a row on the edge's inner side.
inline void clip_row(const EdgeFunction& edge, std::int64_t y, std::int64_t& first,
                     std::int64_t& last) {
  const std::int64_t slack = edge.value(kSubsteps / 2, y) - edge.threshold;
  const std::int64_t step = -edge.dy * kSubsteps;
  if (step > 0) {
    first = std::max(first, ceil_divide(-slack, step));
  } else if (step < 0) {
    last = std::min(last, floor_divide(slack, -step));
  } else if (slack < 0) {
    last = first - 1;
  }
}

}  // namespace raster

//! Calls visit(x, y, b1, b2) for each sample in the triangle, b1 and b2 being its barycentric
//! coordinates for corners 1 and 2. Sample (x, y) stands at (x + 0.5, y + 0.5). Triangles that
//! share an edge never visit a sample twice, nor leave one out between them.
//! \param corners  in units of samples; triangles that reach beyond +-4e6 are left out
template <class Visit>
void for_each_sample(const Corners& corners, int width, int height, Visit&& visit) {
  using raster::kSubsteps;
  for (const auto& corner : corners) {
    if (!(corner.cwiseAbs().maxCoeff() < raster::kLargestCoordinate)) return;
  }
  const auto p0 = raster::to_grid(corners[0]);
  auto p1 = raster::to_grid(corners[1]);
  auto p2 = raster::to_grid(corners[2]);
  std::int64_t area = raster::EdgeFunction(p0, p1).value(p2.x, p2.y);
  if (area == 0) return;
  const bool mirrored = area < 0;
  if (mirrored) {
    std::swap(p1, p2);
    area = -area;
  }
  const raster::EdgeFunction opposite0(p1, p2);
  const raster::EdgeFunction opposite1(p2, p0);
  const raster::EdgeFunction opposite2(p0, p1);

  const auto [left, right] = std::minmax({p0.x, p1.x, p2.x});
  const auto [top, bottom] = std::minmax({p0.y, p1.y, p2.y});
  const auto first_of = [](std::int64_t low) {
    return std::max<std::int64_t>(0, raster::floor_divide(low, kSubsteps));
  };
  const auto last_of = [](std::int64_t high, int size) {
    return std::min<std::int64_t>(size - 1, raster::floor_divide(high, kSubsteps));
  };
  for (std::int64_t row = first_of(top); row <= last_of(bottom, height); ++row) {
    const std::int64_t y = row * kSubsteps + kSubsteps / 2;
    std::int64_t first = first_of(left);
    std::int64_t last = last_of(right, width);
    raster::clip_row(opposite0, y, first, last);
    raster::clip_row(opposite1, y, first, last);
    raster::clip_row(opposite2, y, first, last);
    for (std::int64_t column = first; column <= last; ++column) {
      const std::int64_t x = column * kSubsteps + kSubsteps / 2;
      double b1 = static_cast<double>(opposite1.value(x, y)) / static_cast<double>(area);
      double b2 = static_cast<double>(opposite2.value(x, y)) / static_cast<double>(area);
      if (mirrored) std::swap(b1, b2);
      visit(static_cast<int>(column), static_cast<int>(row), b1, b2);
    }
  }
}

}  // namespace flbc::draw
