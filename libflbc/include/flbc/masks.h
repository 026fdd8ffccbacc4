// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Masks: regions that some control points must not move.
#pragma once

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "flbc/errors.h"
#include "flbc/types.h"

namespace flbc {

//! The weights of these control points are exactly 0 at these points. A mask ends at the facets of
//! its control points, where weights are known.
struct Mask {
  std::vector<Index> control_points;  //!< indices in [0, n), in any order
  std::vector<Index> points;          //!< indices of the points of the region, in any order

  friend bool operator==(const Mask& a, const Mask& b) {
    return a.control_points == b.control_points && a.points == b.points;
  }
};

//! Several masks, by point.
class PointMasks {
 public:
  //! No masks.
  PointMasks() = default;

  //! \param masks  may overlap
  //! \param num_control_points  n \param num_points  P
  //! \throws InputError naming the mask and the index that is out of range
  PointMasks(const std::vector<Mask>& masks, Index num_control_points, Index num_points);

  //! Whether no point is masked.
  bool empty() const { return masked_.empty(); }

  //! Whether control points are masked at a point.
  bool at(Index point) const { return !empty() && !forbidden(point).empty(); }

  //! Whether the weight of a control point is 0 at a point.
  bool forbids(Index point, Index control_point) const;

  //! The masked control points at a point, ascending.
  const std::vector<Index>& forbidden(Index point) const { return kinds_[kind_of_[point]]; }

  //! The other control points, ascending.
  std::vector<Index> allowed(Index point) const;

  //! Whether a sorted support has no masked control point.
  bool permits(Index point, const std::vector<Index>& support) const {
    return !at(point) ||
           std::none_of(support.begin(), support.end(), [&](Index i) { return forbids(point, i); });
  }

  //! Whether the same control points are masked at two points.
  bool same(Index a, Index b) const { return empty() || kind_of_[a] == kind_of_[b]; }

  //! The masked points, ascending.
  const std::vector<Index>& points() const { return masked_; }

  //! The same masks as a list, without points for which `keeps` is false.
  template <class Keeps>
  std::vector<Mask> list(const Keeps& keeps) const {
    std::vector<Mask> masks;
    for (const auto& kind : kinds_) masks.push_back({kind, {}});
    for (const Index point : masked_) {
      if (keeps(point)) masks[kind_of_[point]].points.push_back(point);
    }
    return with_points(std::move(masks));
  }

 private:
  static std::vector<Mask> with_points(std::vector<Mask> masks);

  Index num_control_points_ = 0;
  std::vector<std::vector<Index>> kinds_;  // distinct sets of masked control points; first: none
  std::vector<Index> kind_of_;             // per point
  std::vector<Index> masked_;
};

//! Masked points that no weights >= 0 of the control points that may move them reproduce.
class MaskConflict : public InputError {
 public:
  MaskConflict(const std::string& message, std::vector<Index> masked, std::vector<Index> cure)
      : InputError(message), points(std::move(masked)), control_points(std::move(cure)) {}

  std::vector<Index> points;          //!< ascending
  std::vector<Index> control_points;  //!< ascending; without their masks, all points can obey
};

}  // namespace flbc
