// SPDX-License-Identifier: BSD-3-Clause
#include "caging/gaps.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <map>
#include <set>
#include <utility>

#include <Eigen/Eigenvalues>

#include "base/union_find.h"
#include "caging/grid_lines.h"
#include "flbc/bounding_box.h"

namespace flbc {

namespace {

constexpr int kLines = 128;

// Relative to model size: closer parts touch; shorter gaps are details.
constexpr double kLeastWidth = 4e-3, kLeastLength = 0.2, kLeastDepth = 0.02;

// The lower quartile of the widths of a gap over the upper one: 1/3 in a crease, more in a slot.
constexpr double kLeastEvenness = 0.5;

// Of eight directions, for the mean of some samples.
constexpr int kLeastExits = 2;
constexpr std::size_t kMostTraced = 40;

// Samples in the same block or in neighboring ones belong to one gap.
constexpr double kBlocks = 64;

std::array<GridLines, 3> lines_through(const Cage<3>& shape, const LineGrid& grid) {
  return {GridLines(shape, 0, grid), GridLines(shape, 1, grid), GridLines(shape, 2, grid)};
}

// The number of the gap of each place.
std::vector<Index> connect(const std::vector<Vector<3>>& places, double block) {
  std::map<std::array<int, 3>, Index> first_in;
  std::vector<std::array<int, 3>> block_of;
  UnionFind gaps(static_cast<Index>(places.size()));
  for (Index s = 0; s < static_cast<Index>(places.size()); ++s) {
    const Eigen::Array3i b = (places[s] / block).array().floor().cast<int>();
    block_of.push_back({b(0), b(1), b(2)});
    gaps.unite(first_in.emplace(block_of.back(), s).first->second, s);
  }
  for (const auto& [b, s] : first_in) {
    for (int k = 0; k < 27; ++k) {
      const auto near = first_in.find({b[0] + k % 3 - 1, b[1] + k / 3 % 3 - 1, b[2] + k / 9 - 1});
      if (near != first_in.end()) gaps.unite(near->second, s);
    }
  }
  std::vector<Index> numbers;
  for (Index s = 0; s < static_cast<Index>(places.size()); ++s) numbers.push_back(gaps.find(s));
  return numbers;
}

// The second largest extent of places that are spread evenly.
double depth_of(const std::vector<Vector<3>>& places) {
  Eigen::Map<const PointList<3>> all(places.front().data(), 3,
                                     static_cast<Eigen::Index>(places.size()));
  const PointList<3> centered = all.colwise() - all.rowwise().mean();
  const Eigen::Matrix3d covariance = centered * centered.transpose() / double(places.size());
  return std::sqrt(12 *
                   Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(covariance).eigenvalues()(1));
}

// The number of eight directions along a gap that lead out of it.
int count_exits(const Enclosure<3>& model, const Vector<3>& place) {
  constexpr double kHit = 0.3;  // of the distance at the start
  const Vector<3> normal = (place - model.nearest_point(place)).normalized();
  const Vector<3> side = normal.unitOrthogonal(), other = normal.cross(side);
  const double width = model.distance(place), high = std::sqrt(0.5);
  const std::pair<double, double> around[] = {{1, 0},  {high, high},   {0, 1},  {-high, high},
                                              {-1, 0}, {-high, -high}, {0, -1}, {high, -high}};
  int exits = 0;
  for (const auto& [along, across] : around) {
    Vector<3> p = place;
    double step = width;
    while (step > kHit * width && model.box().contains(p)) {
      p += step * (along * side + across * other);
      step = model.distance(p);
    }
    exits += step > kHit * width ? 1 : 0;
  }
  return exits;
}

}  // namespace

Gaps::Gaps(const Cage<3>& model, const Enclosure<3>& enclosure) : box_(3, 2) {
  box_ << model.points.rowwise().minCoeff(), model.points.rowwise().maxCoeff();
  const double size = bounding_box_diagonal<3>(box_);
  const LineGrid grid(box_, Eigen::Array3i::Constant(kLines));
  if (!(grid.step.minCoeff() > 0)) return;
  const auto lines = lines_through(model, grid);
  std::vector<Vector<3>> places;
  for (int axis = 0; axis < 3; ++axis) {
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    Eigen::Array3i cell = Eigen::Array3i::Zero();
    for (cell(u) = 0; cell(u) < kLines; ++cell(u)) {
      for (cell(v) = 0; cell(v) < kLines; ++cell(v)) {
        const auto parts = lines[axis].parts_at(cell);
        for (std::size_t k = 1; k < parts.size(); ++k) {
          const auto [begin, end] = std::pair(parts[k - 1].second, parts[k].first);
          const double thickness = std::min(begin - parts[k - 1].first, parts[k].second - end);
          if (end - begin < kLeastWidth * size || end - begin > thickness) continue;
          Sample sample{{}, 0, axis, cell, 0};
          for (const int other : {u, v}) {
            sample.place(other) = grid.coordinate(other, cell(other));
          }
          sample.place(axis) = (begin + end) / 2;
          sample.cell(axis) = std::clamp(
              static_cast<int>(std::round(grid.place(axis, sample.place(axis)))), 0, kLines - 1);
          places.push_back(sample.place);
          samples_.push_back(sample);
        }
      }
    }
  }
  const auto numbers = connect(places, size / kBlocks);
  std::map<Index, Eigen::AlignedBox3d> extents;
  std::map<Index, std::vector<double>> widths;
  std::map<Index, std::vector<Vector<3>>> places_of;
  for (std::size_t s = 0; s < samples_.size(); ++s) {
    samples_[s].gap = numbers[s];
    samples_[s].width = 2 * enclosure.distance(places[s]);
    extents[numbers[s]].extend(places[s]);
    places_of[numbers[s]].push_back(places[s]);
    widths[numbers[s]].push_back(samples_[s].width);
  }
  std::set<Index> slots;
  for (auto& [gap, all] : widths) {
    std::sort(all.begin(), all.end());
    const double low = all[all.size() / 4], high = all[3 * all.size() / 4];
    const bool is_long = extents[gap].diagonal().norm() >= kLeastLength * size;
    // A groove is long, but not deep.
    const bool is_deep = depth_of(places_of[gap]) >= kLeastDepth * size;
    if (is_long && is_deep && low >= kLeastEvenness * high) slots.insert(gap);
  }
  for (auto slot = slots.begin(); slot != slots.end();) {
    // Of some of its samples, because this takes long.
    const std::size_t step = 1 + widths[*slot].size() / kMostTraced;
    std::size_t number = 0, traced = 0;
    int exits = 0;
    for (const auto& sample : samples_) {
      if (sample.gap != *slot || number++ % step > 0) continue;
      exits += count_exits(enclosure, sample.place);
      ++traced;
    }
    slot = exits < kLeastExits * static_cast<int>(traced) ? slots.erase(slot) : std::next(slot);
  }
  samples_.erase(std::remove_if(samples_.begin(), samples_.end(),
                                [&](const Sample& s) { return slots.count(s.gap) == 0; }),
                 samples_.end());
}

std::vector<BridgedGap<3>> Gaps::bridged_by(const Cage<3>& cage) const {
  if (samples_.empty()) return {};
  const LineGrid grid(box_, Eigen::Array3i::Constant(kLines));
  const auto lines = lines_through(cage, grid);
  std::map<Index, std::pair<Index, std::vector<const Sample*>>> inside;  // with the number of all
  for (const auto& sample : samples_) {
    auto& [all, within] = inside[sample.gap];
    ++all;
    for (const auto& [begin, end] : lines[sample.axis].parts_at(sample.cell)) {
      const double place = sample.place(sample.axis);
      if (place > begin && place < end) within.push_back(&sample);
    }
  }
  std::vector<std::pair<std::size_t, BridgedGap<3>>> gaps;
  for (auto& [number, counts] : inside) {
    auto& [all, within] = counts;
    if (2 * within.size() <= static_cast<std::size_t>(all)) continue;
    // The narrowest quarter may be where the parts meet.
    const auto place = within.begin() + static_cast<std::ptrdiff_t>(within.size() / 4);
    std::nth_element(within.begin(), place, within.end(), [](const Sample* a, const Sample* b) {
      return a->width != b->width ? a->width < b->width : a < b;
    });
    gaps.push_back({within.size(), {(*place)->place, (*place)->width}});
  }
  std::stable_sort(gaps.begin(), gaps.end(),
                   [](const auto& a, const auto& b) { return a.first > b.first; });
  std::vector<BridgedGap<3>> result;
  for (const auto& gap : gaps) result.push_back(gap.second);
  return result;
}

}  // namespace flbc
