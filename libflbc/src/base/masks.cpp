// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/masks.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <string>
#include <utility>

#include "flbc/errors.h"

namespace flbc {
namespace {

void require_in_range(const std::vector<Index>& numbers, Index end, std::size_t mask,
                      const char* what) {
  for (const Index number : numbers) {
    if (number >= 0 && number < end) continue;
    throw InputError("mask " + std::to_string(mask) + " names " + what + " " +
                     std::to_string(number) + "; there are " + std::to_string(end) +
                     ", counted from 0");
  }
}

}  // namespace

PointMasks::PointMasks(const std::vector<Mask>& masks, Index num_control_points, Index num_points)
    : num_control_points_(num_control_points) {
  std::vector<std::vector<Index>> masks_of(num_points);
  for (std::size_t k = 0; k < masks.size(); ++k) {
    require_in_range(masks[k].control_points, num_control_points, k, "control point");
    require_in_range(masks[k].points, num_points, k, "vertex");
    if (masks[k].control_points.empty()) continue;
    for (const Index point : masks[k].points) masks_of[point].push_back(static_cast<Index>(k));
  }
  std::map<std::vector<Index>, Index> known{{{}, 0}};  // by the masks of a point
  kinds_.emplace_back();
  kind_of_.assign(num_points, 0);
  for (Index point = 0; point < num_points; ++point) {
    if (masks_of[point].empty()) continue;
    masked_.push_back(point);
    const auto [place, is_new] = known.try_emplace(masks_of[point], kinds_.size());
    kind_of_[point] = place->second;
    if (!is_new) continue;
    std::vector<Index> kind;
    for (const Index k : masks_of[point]) {
      kind.insert(kind.end(), masks[k].control_points.begin(), masks[k].control_points.end());
    }
    std::sort(kind.begin(), kind.end());
    kind.erase(std::unique(kind.begin(), kind.end()), kind.end());
    kinds_.push_back(std::move(kind));
  }
}

bool PointMasks::forbids(Index point, Index control_point) const {
  if (empty()) return false;
  const auto& kind = forbidden(point);
  return std::binary_search(kind.begin(), kind.end(), control_point);
}

std::vector<Index> PointMasks::allowed(Index point) const {
  std::vector<Index> others;
  for (Index i = 0; i < num_control_points_; ++i) {
    if (!forbids(point, i)) others.push_back(i);
  }
  return others;
}

std::vector<Mask> PointMasks::with_points(std::vector<Mask> masks) {
  masks.erase(std::remove_if(masks.begin(), masks.end(),
                             [](const Mask& mask) { return mask.points.empty(); }),
              masks.end());
  return masks;
}

}  // namespace flbc
