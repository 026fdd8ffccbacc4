// SPDX-License-Identifier: BSD-3-Clause
#include "caging/cage_steps.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

namespace flbc {

namespace {

// Lines along each side of the bounding box.
constexpr int kLines = 200;

// Parallel lines on a grid, and the places where triangles cross them.
class Lines {
 public:
  Lines(const PointList<3>& points, int axis)
      : points_(points), axis_(axis), u_((axis + 1) % 3), v_((axis + 2) % 3) {
    low_ = points.rowwise().minCoeff();
    step_ = (points.rowwise().maxCoeff() - low_) / kLines;
    crossings_.resize(kLines * kLines);
  }

  void cross(Index a, Index b, Index c) {
    const auto p = points_.col(a), q = points_.col(b), r = points_.col(c);
    const double area = (q(u_) - p(u_)) * (r(v_) - p(v_)) - (q(v_) - p(v_)) * (r(u_) - p(u_));
    if (!(std::abs(area) > 0)) return;
    const auto [u_begin, u_end] = range(u_, {p(u_), q(u_), r(u_)});
    const auto [v_begin, v_end] = range(v_, {p(v_), q(v_), r(v_)});
    for (int i = u_begin; i < u_end; ++i) {
      for (int j = v_begin; j < v_end; ++j) {
        const double x = line(u_, i), y = line(v_, j);
        const double s = ((x - p(u_)) * (r(v_) - p(v_)) - (y - p(v_)) * (r(u_) - p(u_))) / area;
        const double t = ((q(u_) - p(u_)) * (y - p(v_)) - (q(v_) - p(v_)) * (x - p(u_))) / area;
        if (s < 0 || t < 0 || s + t > 1) continue;
        const double place = p(axis_) + s * (q(axis_) - p(axis_)) + t * (r(axis_) - p(axis_));
        crossings_[i * kLines + j].emplace_back(place, area > 0 ? 1 : -1);
      }
    }
  }

  double volume() {
    double length = 0;
    for (auto& line : crossings_) {
      std::sort(line.begin(), line.end());
      int winding = 0;
      double inside = 0;
      for (std::size_t k = 0; k < line.size(); ++k) {
        if (winding != 0) inside += line[k].first - line[k - 1].first;
        winding += line[k].second;
      }
      if (winding == 0) length += inside;
    }
    return length * step_(u_) * step_(v_);
  }

 private:
  // Away from coordinates that vertices of regular models have.
  double line(int axis, int number) const {
    return low_(axis) + (number + 0.5 + 0.0618 * (axis + 1)) * step_(axis);
  }

  std::pair<int, int> range(int axis, const std::array<double, 3>& places) const {
    const auto [least, most] = std::minmax_element(places.begin(), places.end());
    if (!(step_(axis) > 0)) return {0, 0};
    const double begin = (*least - low_(axis)) / step_(axis) - 1;
    const double end = (*most - low_(axis)) / step_(axis) + 1;
    return {std::max(0, static_cast<int>(begin)), std::min(kLines, static_cast<int>(end))};
  }

  const PointList<3>& points_;
  int axis_, u_, v_;
  Vector<3> low_, step_;
  std::vector<std::vector<std::pair<double, int>>> crossings_;
};

}  // namespace

double solid_volume(const PointList<3>& points, const FacetList<3>& facets) {
  std::array<double, 3> volumes{};
  for (int axis = 0; axis < 3; ++axis) {
    Lines lines(points, axis);
    for (Index f = 0; f < facets.cols(); ++f) {
      lines.cross(facets(0, f), facets(1, f), facets(2, f));
    }
    volumes[axis] = lines.volume();
  }
  std::sort(volumes.begin(), volumes.end());
  return volumes[1];
}

bool is_closed(const PointList<3>& points, const FacetList<3>& facets) {
  std::map<std::array<double, 3>, Index> first_at;
  std::vector<Index> place;
  for (Index v = 0; v < points.cols(); ++v) {
    place.push_back(
        first_at.emplace(std::array{points(0, v), points(1, v), points(2, v)}, v).first->second);
  }
  std::map<std::pair<Index, Index>, bool> is_odd;
  for (Index f = 0; f < facets.cols(); ++f) {
    for (int k = 0; k < 3; ++k) {
      const Index a = place[facets(k, f)], b = place[facets((k + 1) % 3, f)];
      if (a != b) is_odd[std::minmax(a, b)] ^= true;
    }
  }
  return std::none_of(is_odd.begin(), is_odd.end(), [](const auto& edge) { return edge.second; });
}

}  // namespace flbc
