// SPDX-License-Identifier: BSD-3-Clause
// Finds boxes that intersect, and the nearest of many elements to a point.
#pragma once

#include <algorithm>
#include <limits>
#include <type_traits>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include "flbc/types.h"

namespace flbc {

//! A binary tree of boxes around elements, split at the median of their centers.
template <int Dim>
class BoxTree {
 public:
  using Box = Eigen::AlignedBox<double, Dim>;

  explicit BoxTree(const std::vector<Box>& boxes) {
    entries_.reserve(boxes.size());
    nodes_.reserve(boxes.size());
    for (const Box& box : boxes) entries_.push_back({box, static_cast<Index>(entries_.size())});
    if (!boxes.empty()) build(0, static_cast<Index>(boxes.size()));
  }

  //! Calls `visit` with the indices of boxes that intersect `query`, until it returns true.
  //! \return whether it did
  template <class Visit>
  bool any_of(const Box& query, const Visit& visit) const {
    return any_of([&](const Box& box) { return box.intersects(query); }, visit);
  }

  //! The same for boxes that fulfill a condition. \param meets  true for a box around such boxes
  template <class Meets, class Visit,
            class = std::enable_if_t<std::is_invocable_v<const Meets&, const Box&>>>
  bool any_of(const Meets& meets, const Visit& visit) const {
    return !nodes_.empty() && search(0, meets, visit);
  }

  //! \param distance_to  of an element from the point: distance_to(element) -> double
  //! \param limit  elements farther away are not found
  //! \return the nearest element; ties go to the smallest index; -1 if there is none
  template <class DistanceTo>
  Index nearest(const Vector<Dim>& point, const DistanceTo& distance_to,
                double limit = std::numeric_limits<double>::infinity()) const {
    Nearest<DistanceTo> search{*this, point, distance_to, limit};
    if (!nodes_.empty()) search.visit(0);
    return search.element;
  }

 private:
  static constexpr Index kLeafSize = 4;

  // In the order of the leaves.
  struct Entry {
    Box box;
    Index element;
  };

  // The first child is the next node, the second child is given by index; leaves have none.
  struct Node {
    Box box;
    Index begin, end, second;
  };

  template <class DistanceTo>
  struct Nearest {
    const BoxTree& tree;
    const Vector<Dim>& point;
    const DistanceTo& distance_to;
    double distance;
    Index element = -1;

    double distance_to_box(const Box& box) const {
      return (point.cwiseMax(box.min()).cwiseMin(box.max()) - point).norm();
    }

    void visit(Index number) {
      const Node& node = tree.nodes_[number];
      if (node.second < 0) {
        for (Index k = node.begin; k < node.end; ++k) consider(tree.entries_[k]);
        return;
      }
      Index near = number + 1, far = node.second;
      double to_near = distance_to_box(tree.nodes_[near].box);
      double to_far = distance_to_box(tree.nodes_[far].box);
      if (to_far < to_near) {
        std::swap(near, far);
        std::swap(to_near, to_far);
      }
      if (to_near <= distance) visit(near);
      if (to_far <= distance) visit(far);
    }

    void consider(const Entry& candidate) {
      if (distance_to_box(candidate.box) > distance) return;
      const double found = distance_to(candidate.element);
      // A distance that overflows is infinite.
      const bool is_first = element < 0 || candidate.element < element;
      if (!(found < distance || (found == distance && is_first))) return;
      distance = found;
      element = candidate.element;
    }
  };

  Index build(Index begin, Index end) {
    const auto self = static_cast<Index>(nodes_.size());
    Box box;
    for (Index k = begin; k < end; ++k) box.extend(entries_[k].box);
    nodes_.push_back({box, begin, end, -1});
    if (end - begin <= kLeafSize) return self;
    int axis = 0;
    box.sizes().maxCoeff(&axis);
    const Index middle = (begin + end) / 2;
    std::nth_element(entries_.begin() + begin, entries_.begin() + middle, entries_.begin() + end,
                     [&](const Entry& a, const Entry& b) {
                       const double p = a.box.center()(axis), q = b.box.center()(axis);
                       return p != q ? p < q : a.element < b.element;
                     });
    build(begin, middle);
    const Index second = build(middle, end);
    nodes_[self].second = second;
    return self;
  }

  template <class Meets, class Visit>
  bool search(Index number, const Meets& meets, const Visit& visit) const {
    const Node& node = nodes_[number];
    if (!meets(node.box)) return false;
    if (node.second >= 0) {
      return search(number + 1, meets, visit) || search(node.second, meets, visit);
    }
    for (Index k = node.begin; k < node.end; ++k) {
      if (meets(entries_[k].box) && visit(entries_[k].element)) return true;
    }
    return false;
  }

  std::vector<Entry> entries_;
  std::vector<Node> nodes_;
};

//! The boxes of facets or other lists of corners. \param corners  K x E
template <int Dim, int K>
std::vector<Eigen::AlignedBox<double, Dim>> boxes_of(const PointList<Dim>& points,
                                                     const FacetList<K>& corners) {
  std::vector<Eigen::AlignedBox<double, Dim>> boxes(corners.cols());
  for (Index e = 0; e < corners.cols(); ++e) {
    for (int k = 0; k < K; ++k) boxes[e].extend(Vector<Dim>(points.col(corners(k, e))));
  }
  return boxes;
}

//! Pairs f < g of boxes within the distance of each other, in ascending order.
template <int Dim>
std::vector<std::pair<Index, Index>> close_pairs(
    const std::vector<Eigen::AlignedBox<double, Dim>>& boxes, double distance) {
  const BoxTree<Dim> tree(boxes);
  const Vector<Dim> margin = Vector<Dim>::Constant(distance);
  std::vector<std::pair<Index, Index>> pairs;
  for (Index f = 0; f < static_cast<Index>(boxes.size()); ++f) {
    tree.any_of({boxes[f].min() - margin, boxes[f].max() + margin}, [&](Index g) {
      if (g < f) pairs.emplace_back(g, f);
      return false;
    });
  }
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

}  // namespace flbc
