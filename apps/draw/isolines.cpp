// SPDX-License-Identifier: BSD-3-Clause
#include "draw/isolines.h"

#include <algorithm>
#include <array>
#include <utility>

namespace flbc::draw {
namespace {

constexpr double kPlateau = 1e-7;

// The place of a level on the edge between two vertices, whatever their order: both cells at an
// edge find bitwise the same point.
Vector<2> crossing(const PointList<2>& points, const Eigen::VectorXd& values, Index a, Index b,
                   double level) {
  if (a > b) std::swap(a, b);
  const double t = (level - values[a]) / (values[b] - values[a]);
  return points.col(a) + t * (points.col(b) - points.col(a));
}

}  // namespace

std::vector<double> isoline_levels(int n) {
  std::vector<double> levels;
  for (int k = 1; k < n; ++k) levels.push_back(static_cast<double>(k) / n);
  return levels;
}

std::vector<Segment> trace_isolines(const PointList<2>& points, const CellList<2>& cells,
                                    const Eigen::VectorXd& values,
                                    const std::vector<double>& levels) {
  std::vector<Segment> segments;
  for (Eigen::Index s = 0; s < cells.cols(); ++s) {
    const std::array<Index, 3> v{cells(0, s), cells(1, s), cells(2, s)};
    const auto [low, high] = std::minmax({values[v[0]], values[v[1]], values[v[2]]});
    if (high - low < kPlateau) continue;
    // A vertex exactly on the level counts as above it, in all its cells.
    for (auto level = std::upper_bound(levels.begin(), levels.end(), low);
         level != levels.end() && *level <= high; ++level) {
      const auto above = [&](int k) { return values[v[k]] >= *level; };
      const int lone = above(1) == above(2) ? 0 : above(0) == above(2) ? 1 : 2;
      segments.push_back({crossing(points, values, v[lone], v[(lone + 1) % 3], *level),
                          crossing(points, values, v[lone], v[(lone + 2) % 3], *level)});
    }
  }
  return segments;
}

}  // namespace flbc::draw
