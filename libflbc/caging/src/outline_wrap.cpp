// SPDX-License-Identifier: BSD-3-Clause
// Wraps a model in the plane with closed lines along the cells of a grid.
#include <algorithm>
#include <cmath>
#include <vector>

#include "caging/cage_steps.h"
#include "caging/surface_tools.h"

namespace flbc {

namespace {

// Maximum number of cells along an axis, and number of cells per offset within this limit.
constexpr double kMostCells = 600;
constexpr double kCellsPerOffset = 2;

// A grid of marked cells with an unmarked margin.
class Grid {
 public:
  Grid(const Eigen::AlignedBox2d& box, double cell)
      : cell_(cell),
        width_(static_cast<Index>(std::ceil(box.sizes().x() / cell)) + 2),
        height_(static_cast<Index>(std::ceil(box.sizes().y() / cell)) + 2),
        low_(box.center() - 0.5 * cell * Vector<2>(width_, height_)),
        marks_(static_cast<std::size_t>(width_) * height_, false) {}

  Index width() const { return width_; }
  Index height() const { return height_; }
  double cell() const { return cell_; }
  Vector<2> corner(Index i, Index j) const { return low_ + cell_ * Vector<2>(i, j); }
  Vector<2> centre(Index i, Index j) const { return low_ + cell_ * Vector<2>(i + 0.5, j + 0.5); }
  bool is_marked(Index i, Index j) const {
    return i >= 0 && j >= 0 && i < width_ && j < height_ && marks_[i + j * width_];
  }
  void mark(Index i, Index j, bool value = true) { marks_[i + j * width_] = value; }

 private:
  double cell_;
  Index width_, height_;
  Vector<2> low_;
  std::vector<bool> marks_;
};

template <class Action>
void for_each_cell(const Grid& grid, const Action& action) {
  for (Index j = 0; j < grid.height(); ++j) {
    for (Index i = 0; i < grid.width(); ++i) action(i, j);
  }
}

// Unmarks cells within a given number of cells of an unmarked one.
void erode(Grid& grid, double radius) {
  const auto reach = static_cast<Index>(radius);
  const Grid before = grid;
  for_each_cell(before, [&](Index i, Index j) {
    if (!before.is_marked(i, j)) return;
    for (Index dj = -reach; dj <= reach; ++dj) {
      for (Index di = -reach; di <= reach; ++di) {
        if (di * di + dj * dj > radius * radius || before.is_marked(i + di, j + dj)) continue;
        grid.mark(i, j, false);
        return;
      }
    }
  });
}

// Marks all cells that are not connected to the margin. \return whether there were any
bool fill_holes(Grid& grid) {
  Grid outside = grid;
  std::vector<std::pair<Index, Index>> front{{0, 0}};
  outside.mark(0, 0);
  while (!front.empty()) {
    const auto [i, j] = front.back();
    front.pop_back();
    for (const auto& [di, dj] : {std::pair<Index, Index>{1, 0}, {-1, 0}, {0, 1}, {0, -1}}) {
      const Index k = i + di, l = j + dj;
      if (k < 0 || l < 0 || k >= grid.width() || l >= grid.height()) continue;
      if (outside.is_marked(k, l)) continue;
      outside.mark(k, l);
      front.push_back({k, l});
    }
  }
  bool has_filled = false;
  for_each_cell(grid, [&](Index i, Index j) {
    if (outside.is_marked(i, j)) return;
    grid.mark(i, j);
    has_filled = true;
  });
  return has_filled;
}

// Adds a common neighbor to cells that touch only at a corner. \return whether there were any
bool part_touching_corners(Grid& grid) {
  bool has_marked = false;
  for (Index j = 1; j < grid.height(); ++j) {
    for (Index i = 1; i < grid.width(); ++i) {
      const bool rising = grid.is_marked(i - 1, j - 1) && grid.is_marked(i, j);
      const bool falling = grid.is_marked(i - 1, j) && grid.is_marked(i, j - 1);
      const int marked = grid.is_marked(i - 1, j - 1) + grid.is_marked(i, j) +
                         grid.is_marked(i - 1, j) + grid.is_marked(i, j - 1);
      if (marked != 2 || rising == falling) continue;
      rising ? grid.mark(i, j - 1) : grid.mark(i, j);
      has_marked = true;
    }
  }
  return has_marked;
}

// Sides between marked and unmarked cells, the marked ones on the left.
Cage<2> outline(const Grid& grid) {
  const Index columns = grid.width() + 1;
  std::vector<FacetCorners<2>> edges;
  const auto corner = [&](Index i, Index j) { return i + j * columns; };
  for_each_cell(grid, [&](Index i, Index j) {
    if (!grid.is_marked(i, j)) return;
    if (!grid.is_marked(i, j - 1)) edges.push_back({corner(i, j), corner(i + 1, j)});
    if (!grid.is_marked(i + 1, j)) edges.push_back({corner(i + 1, j), corner(i + 1, j + 1)});
    if (!grid.is_marked(i, j + 1)) edges.push_back({corner(i + 1, j + 1), corner(i, j + 1)});
    if (!grid.is_marked(i - 1, j)) edges.push_back({corner(i, j + 1), corner(i, j)});
  });
  PointList<2> corners(2, columns * (grid.height() + 1));
  for (Index j = 0; j <= grid.height(); ++j) {
    for (Index i = 0; i < columns; ++i) corners.col(corner(i, j)) = grid.corner(i, j);
  }
  return compact<2>(corners, edges);
}

}  // namespace

Cage<2> wrap(const Enclosure<2>& model, const WrapSize& size) {
  const double reach = std::max(size.offset, size.alpha / 2);
  auto box = model.box();
  const double margin = 2 * reach;
  box.extend(Vector<2>(box.min().array() - margin));
  box.extend(Vector<2>(box.max().array() + margin));
  Grid grid(box, std::max(size.offset / kCellsPerOffset, box.sizes().maxCoeff() / kMostCells));
  const double half_diagonal = grid.cell() / std::sqrt(2.0);
  for_each_cell(grid, [&](Index i, Index j) {
    if (model.is_within(grid.centre(i, j), reach + half_diagonal)) grid.mark(i, j);
  });
  fill_holes(grid);
  erode(grid, (reach - size.offset) / grid.cell());
  while (part_touching_corners(grid) || fill_holes(grid)) {
  }
  return outline(grid);
}

}  // namespace flbc
