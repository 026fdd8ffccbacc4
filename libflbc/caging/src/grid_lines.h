// SPDX-License-Identifier: BSD-3-Clause
// What lines through a model find inside of it.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "flbc/cage.h"

namespace flbc {

// Coordinates along x, y, and z, away from those that vertices of regular models have.
struct LineGrid {
  Vector<3> low, step;
  Eigen::Array3i counts;

  LineGrid(const PointList<3>& points, const Eigen::Array3i& numbers) : counts(numbers) {
    low = points.rowwise().minCoeff();
    step = (points.rowwise().maxCoeff() - low).array() / counts.cast<double>();
  }

  static double shift(int axis) { return 0.5 + 0.0618 * (axis + 1); }
  double coordinate(int axis, int number) const {
    return low(axis) + (number + shift(axis)) * step(axis);
  }
  double place(int axis, double coordinate) const {
    return (coordinate - low(axis)) / step(axis) - shift(axis);
  }

  Index number_of(const Eigen::Array3i& cell) const {
    return (cell(0) * counts(1) + cell(1)) * counts(2) + cell(2);
  }
};

// Lines of a grid along an axis, and the places where triangles cross them.
class GridLines {
 public:
  GridLines(const Cage<3>& model, int axis, const LineGrid& grid)
      : points_(model.points), axis_(axis), u_((axis + 1) % 3), v_((axis + 2) % 3), grid_(grid) {
    crossings_.resize(static_cast<std::size_t>(grid.counts(u_) * grid.counts(v_)));
    for (const auto& facet : model.facets.colwise()) cross(facet(0), facet(1), facet(2));
    for (auto& line : crossings_) std::sort(line.begin(), line.end());
  }

  // The ends of the parts that are inside, on the line through the point of a cell.
  std::vector<std::pair<double, double>> parts_at(const Eigen::Array3i& cell) const {
    std::vector<std::pair<double, double>> parts;
    const auto& line = crossings_[number(cell(u_), cell(v_))];
    if (passes_opening(line)) return parts;
    for_inside(line, [&](double begin, double end) {
      const bool is_same = !parts.empty() && begin == parts.back().second;
      if (is_same) {
        parts.back().second = end;
      } else {
        parts.emplace_back(begin, end);
      }
    });
    return parts;
  }

  double volume() const {
    double length = 0;
    for (const auto& line : crossings_) {
      if (passes_opening(line)) continue;
      for_inside(line, [&](double begin, double end) { length += end - begin; });
    }
    return length * grid_.step(u_) * grid_.step(v_);
  }

  // Adds 1 for every cell of the grid whose point is inside, and -1 if it is outside.
  void count_inside(std::vector<int>& counts) const {
    Eigen::Array3i cell;
    const auto add = [&](double begin, double end, int count) {
      for (cell(axis_) = 0; cell(axis_) < grid_.counts(axis_); ++cell(axis_)) {
        const double place = grid_.coordinate(axis_, cell(axis_));
        if (place > begin && place < end) counts[grid_.number_of(cell)] += count;
      }
    };
    constexpr double kFar = std::numeric_limits<double>::infinity();
    for (cell(u_) = 0; cell(u_) < grid_.counts(u_); ++cell(u_)) {
      for (cell(v_) = 0; cell(v_) < grid_.counts(v_); ++cell(v_)) {
        const auto& line = crossings_[number(cell(u_), cell(v_))];
        if (passes_opening(line)) continue;
        add(-kFar, kFar, -1);
        for_inside(line, [&](double begin, double end) { add(begin, end, 2); });
      }
    }
  }

 private:
  void cross(Index a, Index b, Index c) {
    const auto p = points_.col(a), q = points_.col(b), r = points_.col(c);
    const double area = (q(u_) - p(u_)) * (r(v_) - p(v_)) - (q(v_) - p(v_)) * (r(u_) - p(u_));
    if (!(std::abs(area) > 0)) return;
    const auto [u_begin, u_end] = range(u_, {p(u_), q(u_), r(u_)});
    const auto [v_begin, v_end] = range(v_, {p(v_), q(v_), r(v_)});
    for (int i = u_begin; i < u_end; ++i) {
      for (int j = v_begin; j < v_end; ++j) {
        const double x = grid_.coordinate(u_, i), y = grid_.coordinate(v_, j);
        const double s = ((x - p(u_)) * (r(v_) - p(v_)) - (y - p(v_)) * (r(u_) - p(u_))) / area;
        const double t = ((q(u_) - p(u_)) * (y - p(v_)) - (q(v_) - p(v_)) * (x - p(u_))) / area;
        if (s < 0 || t < 0 || s + t > 1) continue;
        const double place = p(axis_) + s * (q(axis_) - p(axis_)) + t * (r(axis_) - p(axis_));
        crossings_[number(i, j)].emplace_back(place, area > 0 ? 1 : -1);
      }
    }
  }

  // A place on the line, and whether the triangle there faces back (1) or along it (-1).
  using Crossing = std::pair<double, int>;

  static bool passes_opening(const std::vector<Crossing>& line) {
    int winding = 0;
    for (const auto& crossing : line) winding += crossing.second;
    return winding != 0;
  }

  // Calls the function with both ends of each part of a line that is inside.
  template <class Function>
  static void for_inside(const std::vector<Crossing>& line, const Function& function) {
    int winding = 0;
    for (std::size_t k = 0; k < line.size(); ++k) {
      if (winding != 0) function(line[k - 1].first, line[k].first);
      winding += line[k].second;
    }
  }

  std::size_t number(int i, int j) const {
    return static_cast<std::size_t>(i * grid_.counts(v_) + j);
  }

  std::pair<int, int> range(int axis, const std::array<double, 3>& places) const {
    const auto [least, most] = std::minmax_element(places.begin(), places.end());
    if (!(grid_.step(axis) > 0)) return {0, 0};
    return {std::max(0, static_cast<int>(std::ceil(grid_.place(axis, *least)))),
            std::min(grid_.counts(axis), static_cast<int>(std::ceil(grid_.place(axis, *most))))};
  }

  const PointList<3>& points_;
  int axis_, u_, v_;
  const LineGrid& grid_;
  std::vector<std::vector<Crossing>> crossings_;
};

}  // namespace flbc
