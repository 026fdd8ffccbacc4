// SPDX-License-Identifier: BSD-3-Clause
#include "caging/cage_steps.h"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "base/first_equals.h"
#include "caging/grid_lines.h"

namespace flbc {

namespace {

// A line through two openings may be wrong.
bool is_majority(int count) {
  return count > 0;
}

}  // namespace

double solid_volume(const Cage<3>& model, bool is_closed) {
  constexpr int kLines = 200;
  const LineGrid grid(model.points, Eigen::Array3i::Constant(kLines));
  std::array<double, 3> volumes{};
  if (is_closed) return GridLines(model, 0, grid).volume();
  for (int axis = 0; axis < 3; ++axis) volumes[axis] = GridLines(model, axis, grid).volume();
  std::sort(volumes.begin(), volumes.end());
  return volumes[1];
}

Cage<3> filled(const Cage<3>& model, double spacing) {
  const Vector<3> sides = model.points.rowwise().maxCoeff() - model.points.rowwise().minCoeff();
  const LineGrid grid(model.points, (sides.array() / spacing).ceil().cast<int>().max(1));
  std::vector<int> counts(static_cast<std::size_t>(grid.counts.prod()), 0);
  for (int axis = 0; axis < 3; ++axis) GridLines(model, axis, grid).count_inside(counts);
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
