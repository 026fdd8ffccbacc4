// SPDX-License-Identifier: BSD-3-Clause
#include <limits>
#include <string>

#include "base/messages.h"
#include "caging/repair_steps.h"
#include "caging/ridges.h"
#include "caging/surface_tools.h"

namespace flbc {

namespace {

constexpr std::size_t kLongestLoop = 64;

using Start = std::pair<Index, Index>;  // patch and control point

// The open edges, reversed, so loops have the orientation of new triangles.
// \param patches  per facet: edges of different ones are in different loops
std::map<Start, std::vector<Index>> open_edges(const CageDraft<3>& draft, const RidgeMap<3>& ridges,
                                               const std::vector<Index>& patches) {
  std::map<Start, std::vector<Index>> next;
  for (std::size_t f = 0; f < draft.facets.size(); ++f) {
    const auto& corners = draft.facets[f].corners;
    for (int k = 0; k < 3; ++k) {
      if (ridges.at(ridge_of<3>(corners, k)).size() != 1) continue;
      next[{patches[f], corners((k + 2) % 3)}].push_back(corners((k + 1) % 3));
    }
  }
  return next;
}

// Loops that visit each control point once; other loops are left open.
std::vector<std::vector<Index>> open_loops(const std::map<Start, std::vector<Index>>& next) {
  std::vector<std::vector<Index>> loops;
  for (const auto& [start, ends] : next) {
    const auto& [patch, first] = start;
    std::vector<Index> loop;
    Index at = first;
    bool is_simple = true;
    while (is_simple && (loop.empty() || at != first)) {
      loop.push_back(at);
      const auto found = next.find({patch, at});
      is_simple = found != next.end() && found->second.size() == 1 && loop.size() <= next.size() &&
                  at >= first;
      if (is_simple) at = found->second.front();
    }
    if (is_simple) loops.push_back(loop);
  }
  return loops;
}

// The triangulation of least area, after Barequet and Sharir ("Filling gaps in the boundary of a
// polyhedron", 1995).
class LeastArea {
 public:
  LeastArea(const PointList<3>& points, const std::vector<Index>& loop)
      : points_(points),
        loop_(loop),
        size_(loop.size()),
        best_(size_ * size_),
        cut_(size_ * size_) {
    for (std::size_t length = 2; length < size_; ++length) {
      for (std::size_t i = 0; i + length < size_; ++i) fill(i, i + length);
    }
    collect(0, size_ - 1);
  }

  const std::vector<FacetCorners<3>>& triangles() const { return triangles_; }

 private:
  double area(std::size_t i, std::size_t m, std::size_t j) const {
    Eigen::Matrix3d corners;
    corners << points_.col(loop_[i]), points_.col(loop_[m]), points_.col(loop_[j]);
    return facet_normal<3>(corners).norm();
  }

  void fill(std::size_t i, std::size_t j) {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t m = i + 1; m < j; ++m) {
      const double sum = best_[i * size_ + m] + best_[m * size_ + j] + area(i, m, j);
      if (!(sum < least)) continue;
      least = sum;
      cut_[i * size_ + j] = m;
    }
    best_[i * size_ + j] = least;
  }

  void collect(std::size_t i, std::size_t j) {
    if (j < i + 2) return;
    const std::size_t m = cut_[i * size_ + j];
    triangles_.emplace_back(loop_[i], loop_[m], loop_[j]);
    collect(i, m);
    collect(m, j);
  }

  const PointList<3>& points_;
  const std::vector<Index>& loop_;
  std::size_t size_;
  std::vector<double> best_;
  std::vector<std::size_t> cut_;
  std::vector<FacetCorners<3>> triangles_;
};

}  // namespace

void close_holes(CageDraft<3>& draft) {
  // Patches that touch have loops through the same control points.
  for (const bool by_patch : {false, true}) {
    const auto ridges = collect_ridges(draft);
    const auto patches =
        by_patch ? collect_patches(draft, ridges) : std::vector<Index>(draft.facets.size(), 0);
    for (const auto& loop : open_loops(open_edges(draft, ridges, patches))) {
      if (loop.size() < 3 || loop.size() > kLongestLoop) continue;
      const LeastArea filling(draft.points, loop);
      for (const auto& corners : filling.triangles()) {
        draft.facets.push_back({corners, -1});
      }
      draft.changes.push_back("the hole around control points " + describe_list(loop) +
                              " is closed by " + std::to_string(loop.size() - 2) +
                              " new triangles");
    }
  }
}

void close_holes(CageDraft<2>& draft) {
  // Connects every open end to the other end of its polyline.
  const auto ridges = collect_ridges(draft);
  std::vector<bool> is_closed(static_cast<std::size_t>(draft.points.cols()), false);
  const std::size_t count = draft.facets.size();
  for (const auto& [ridge, edges] : ridges) {
    if (edges.size() != 1 || is_closed[ridge[0]]) continue;
    Index at = ridge[0], edge = edges[0];
    for (std::size_t step = 0; step < count; ++step) {
      const auto& corners = draft.facets[edge].corners;
      at = corners(0) == at ? corners(1) : corners(0);
      const auto& meeting = ridges.at({at});
      if (meeting.size() != 2) break;
      edge = meeting[0] == edge ? meeting[1] : meeting[0];
    }
    if (at == ridge[0] || ridges.at({at}).size() != 1) continue;
    is_closed[at] = is_closed[ridge[0]] = true;
    draft.facets.push_back({{at, ridge[0]}, -1});
    draft.changes.push_back("a new edge joins the open ends at control points " +
                            std::to_string(ridge[0]) + " and " + std::to_string(at));
  }
}

}  // namespace flbc
