// SPDX-License-Identifier: BSD-3-Clause
#include "caging/cage_steps.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "base/first_equals.h"
#include "caging/surface_tools.h"

namespace flbc {

namespace {

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
class Lines {
 public:
  Lines(const Cage<3>& model, int axis, const LineGrid& grid)
      : points_(model.points), axis_(axis), u_((axis + 1) % 3), v_((axis + 2) % 3), grid_(grid) {
    crossings_.resize(static_cast<std::size_t>(grid.counts(u_) * grid.counts(v_)));
    for (const auto& facet : model.facets.colwise()) cross(facet(0), facet(1), facet(2));
    for (auto& line : crossings_) std::sort(line.begin(), line.end());
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
    return {static_cast<int>(std::ceil(grid_.place(axis, *least))),
            std::min(grid_.counts(axis), static_cast<int>(std::ceil(grid_.place(axis, *most))))};
  }

  const PointList<3>& points_;
  int axis_, u_, v_;
  const LineGrid& grid_;
  std::vector<std::vector<Crossing>> crossings_;
};

// A line through two openings may be wrong.
bool is_majority(int count) {
  return count > 0;
}

}  // namespace

double solid_volume(const Cage<3>& model, bool is_closed) {
  constexpr int kLines = 200;
  const LineGrid grid(model.points, Eigen::Array3i::Constant(kLines));
  std::array<double, 3> volumes{};
  if (is_closed) return Lines(model, 0, grid).volume();
  for (int axis = 0; axis < 3; ++axis) volumes[axis] = Lines(model, axis, grid).volume();
  std::sort(volumes.begin(), volumes.end());
  return volumes[1];
}

Cage<3> filled(const Cage<3>& model, double spacing) {
  const Vector<3> sides = model.points.rowwise().maxCoeff() - model.points.rowwise().minCoeff();
  const LineGrid grid(model.points, (sides.array() / spacing).ceil().cast<int>().max(1));
  std::vector<int> counts(static_cast<std::size_t>(grid.counts.prod()), 0);
  for (int axis = 0; axis < 3; ++axis) Lines(model, axis, grid).count_inside(counts);
  Cage<3> solid = model;
  solid.points.conservativeResize(
      3, model.size() + std::count_if(counts.begin(), counts.end(), is_majority));
  Index next = model.size();
  Eigen::Array3i cell;
  for (cell(0) = 0; cell(0) < grid.counts(0); ++cell(0)) {
    for (cell(1) = 0; cell(1) < grid.counts(1); ++cell(1)) {
      for (cell(2) = 0; cell(2) < grid.counts(2); ++cell(2)) {
        if (!is_majority(counts[grid.number_of(cell)])) continue;
        for (int axis = 0; axis < 3; ++axis) {
          solid.points(axis, next) = grid.coordinate(axis, cell(axis));
        }
        ++next;
      }
    }
  }
  return solid;
}

bool is_closed(const Cage<3>& model) {
  const auto place = first_equals<3>(model.points);
  std::vector<std::pair<Index, Index>> edges;
  edges.reserve(static_cast<std::size_t>(model.facets.size()));
  for (const auto& facet : model.facets.colwise()) {
    for (int k = 0; k < 3; ++k) {
      const Index a = place[facet(k)], b = place[facet((k + 1) % 3)];
      if (a != b) edges.emplace_back(std::minmax(a, b));
    }
  }
  std::sort(edges.begin(), edges.end());
  for (std::size_t k = 0; k < edges.size(); k += 2) {
    if (k + 1 == edges.size() || edges[k] != edges[k + 1]) return false;
  }
  return true;
}

}  // namespace flbc
