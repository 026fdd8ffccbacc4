// SPDX-License-Identifier: BSD-3-Clause
#include "draw/polylines.h"

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <utility>

namespace flbc::draw {
namespace {

using Line = std::vector<Vector<2>>;
using Place = std::array<double, 2>;

Place place_of(const Vector<2>& p) {
  return {p.x() + 0.0, p.y() + 0.0};  // -0 is 0
}

// Ends of segments, and which of them meet there.
class SegmentGraph {
 public:
  explicit SegmentGraph(const std::vector<Segment>& segments) {
    std::set<std::pair<int, int>> known;
    for (const auto& segment : segments) {
      if (!segment.a.allFinite() || !segment.b.allFinite()) continue;
      const int a = node_of(segment.a), b = node_of(segment.b);
      if (!known.insert(std::minmax(a, b)).second) continue;
      at_[a].push_back(static_cast<int>(ends_.size()));
      if (a != b) at_[b].push_back(static_cast<int>(ends_.size()));
      ends_.push_back({a, b});
    }
    used_.assign(ends_.size(), false);
  }

  // First lines that end somewhere or branch, then closed ones.
  std::vector<Line> lines() {
    std::vector<Line> all;
    for (const bool closed : {false, true}) {
      for (int edge = 0; edge < static_cast<int>(ends_.size()); ++edge) {
        for (int side = 0; side < 2 && !used_[edge]; ++side) {
          if (closed || at_[ends_[edge][side]].size() != 2) {
            all.push_back(follow(edge, ends_[edge][side]));
          }
        }
      }
    }
    return all;
  }

 private:
  int node_of(const Vector<2>& p) {
    const auto [found, is_new] = nodes_.emplace(place_of(p), static_cast<int>(points_.size()));
    if (is_new) {
      points_.push_back(p);
      at_.emplace_back();
    }
    return found->second;
  }

  // From a node along an edge and on, until there is no edge left.
  Line follow(int edge, int node) {
    Line line{points_[node]};
    while (edge >= 0) {
      used_[edge] = true;
      node = ends_[edge][0] == node ? ends_[edge][1] : ends_[edge][0];
      line.push_back(points_[node]);
      const auto next = std::find_if(at_[node].begin(), at_[node].end(),
                                     [&](int other) { return !used_[other]; });
      edge = next == at_[node].end() ? -1 : *next;
    }
    return line;
  }

  std::map<Place, int> nodes_;
  std::vector<Vector<2>> points_;
  std::vector<std::vector<int>> at_;
  std::vector<std::array<int, 2>> ends_;
  std::vector<bool> used_;
};

double distance_to_segment(const Vector<2>& p, const Vector<2>& a, const Vector<2>& b) {
  const Vector<2> direction = b - a;
  const double length = direction.squaredNorm();
  const double t = length > 0 ? std::clamp((p - a).dot(direction) / length, 0.0, 1.0) : 0.0;
  return (p - a - t * direction).norm();
}

// Douglas and Peucker (1973), without recursion. A closed line keeps its middle point.
Line thin(const Line& line, double tolerance) {
  std::vector<bool> kept(line.size(), false);
  std::vector<std::pair<std::size_t, std::size_t>> spans;
  kept.front() = kept.back() = true;
  const std::size_t middle = line.size() / 2;
  if (line.front() == line.back() && line.size() > 2) {
    kept[middle] = true;
    spans = {{0, middle}, {middle, line.size() - 1}};
  } else {
    spans = {{0, line.size() - 1}};
  }
  while (!spans.empty()) {
    const auto [first, last] = spans.back();
    spans.pop_back();
    double largest = tolerance;
    std::size_t farthest = 0;
    for (std::size_t k = first + 1; k < last; ++k) {
      const double distance = distance_to_segment(line[k], line[first], line[last]);
      if (!(distance > largest)) continue;
      largest = distance;
      farthest = k;
    }
    if (farthest == 0) continue;
    kept[farthest] = true;
    spans.insert(spans.end(), {{first, farthest}, {farthest, last}});
  }
  Line result;
  for (std::size_t k = 0; k < line.size(); ++k) {
    if (kept[k]) result.push_back(line[k]);
  }
  return result;
}

}  // namespace

std::vector<std::vector<Vector<2>>> join_segments(const std::vector<Segment>& segments,
                                                  double tolerance) {
  auto lines = SegmentGraph(segments).lines();
  for (auto& line : lines) line = thin(line, tolerance);
  return lines;
}

}  // namespace flbc::draw
