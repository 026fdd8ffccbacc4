// SPDX-License-Identifier: BSD-3-Clause
#include "meshing/surface_subdivision.h"

#include <algorithm>
#include <array>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "base/messages.h"
#include "flbc/errors.h"

namespace flbc {

namespace {

using Triangle = std::array<Index, 3>;
using Edge = std::pair<Index, Index>;

// A surface during subdivision.
class Subdivision {
 public:
  explicit Subdivision(const Cage<3>& cage) {
    for (Index i = 0; i < cage.size(); ++i) points_.push_back(cage.points.col(i));
    for (Index t = 0; t < cage.facets.cols(); ++t) {
      triangles_.push_back({cage.facets(0, t), cage.facets(1, t), cage.facets(2, t)});
    }
  }

  //! Bisects every triangle with a longer edge at its longest edge. \return whether there was any
  bool divide_long_edges(double longest) {
    middles_.clear();
    for (const Triangle& triangle : triangles_) {
      const int side = longest_side(triangle);
      if (length(triangle, side) > longest) middles_[edge(triangle, side)] = -1;
    }
    for (auto& [ends, middle] : middles_) {
      middle = static_cast<Index>(points_.size());
      points_.push_back((points_[ends.first] + points_[ends.second]) / 2);
    }
    if (middles_.empty()) return false;
    std::vector<Triangle> divided;
    for (const Triangle& triangle : triangles_) divide(triangle, divided);
    triangles_ = std::move(divided);
    return true;
  }

  std::size_t num_points() const { return points_.size(); }

  Cage<3> surface() const {
    Cage<3> result;
    result.points.resize(3, static_cast<Eigen::Index>(points_.size()));
    for (std::size_t i = 0; i < points_.size(); ++i) result.points.col(i) = points_[i];
    result.facets.resize(3, static_cast<Eigen::Index>(triangles_.size()));
    for (std::size_t t = 0; t < triangles_.size(); ++t) {
      for (int k = 0; k < 3; ++k) result.facets(k, t) = triangles_[t][k];
    }
    return result;
  }

 private:
  static Edge edge(const Triangle& triangle, int side) {
    return std::minmax(triangle[side], triangle[(side + 1) % 3]);
  }

  double length(const Triangle& triangle, int side) const {
    const auto [a, b] = edge(triangle, side);
    return (points_[a] - points_[b]).norm();
  }

  int longest_side(const Triangle& triangle) const {
    int longest = 0;
    for (int side = 1; side < 3; ++side) {
      if (length(triangle, side) > length(triangle, longest)) longest = side;
    }
    return longest;
  }

  // Longest edges first, so angles stay above half of the smallest input angle.
  void divide(const Triangle& triangle, std::vector<Triangle>& parts) const {
    int side = -1;
    for (int k = 0; k < 3; ++k) {
      if (middles_.count(edge(triangle, k)) == 0) continue;
      if (side < 0 || length(triangle, k) > length(triangle, side)) side = k;
    }
    if (side < 0) {
      parts.push_back(triangle);
      return;
    }
    const Index a = triangle[side], b = triangle[(side + 1) % 3], c = triangle[(side + 2) % 3];
    const Index middle = middles_.at(edge(triangle, side));
    divide({a, middle, c}, parts);
    divide({middle, b, c}, parts);
  }

  std::vector<Vector<3>> points_;
  std::vector<Triangle> triangles_;
  std::map<Edge, Index> middles_;  // midpoints of divided edges
};

}  // namespace

Cage<3> subdivide_surface(const Cage<3>& cage, double longest, std::size_t most_points) {
  Subdivision subdivision(cage);
  while (subdivision.divide_long_edges(longest)) {
    if (subdivision.num_points() <= most_points) continue;
    throw InputError("the cage surface needs more than " + std::to_string(most_points) +
                     " points for triangles with edges of at most " + format_number(longest) +
                     "; move control points at thin places of the cage apart");
  }
  return subdivision.surface();
}

}  // namespace flbc
