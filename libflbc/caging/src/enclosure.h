// SPDX-License-Identifier: BSD-3-Clause
// Tests whether facets intersect a model, and whether a cage encloses it.
#pragma once

#include <algorithm>
#include <numeric>
#include <vector>

#include <Eigen/Geometry>

#include "caging/cgal/exact_predicates.h"
#include "flbc/cage.h"
#include "flbc/types.h"

namespace flbc {

template <int Dim>
class OverlapTree {
 public:
  using Box = Eigen::AlignedBox<double, Dim>;

  explicit OverlapTree(std::vector<Box> boxes) : boxes_(std::move(boxes)), order_(boxes_.size()) {
    std::iota(order_.begin(), order_.end(), 0);
    nodes_.reserve(boxes_.size());
    if (!boxes_.empty()) build(0, static_cast<Index>(boxes_.size()));
  }

  //! Calls `visit` with the indices of boxes that intersect `query`, until it returns true.
  //! \return whether it did
  template <class Visit>
  bool any_of(const Box& query, const Visit& visit) const {
    return !nodes_.empty() && search(0, query, visit);
  }

 private:
  static constexpr Index kLeafSize = 4;

  // The first child is the next node, the second child is given by index; leaves have none.
  struct Node {
    Box box;
    Index begin, end, second;
  };

  Index build(Index begin, Index end) {
    const auto self = static_cast<Index>(nodes_.size());
    Box box;
    for (Index k = begin; k < end; ++k) box.extend(boxes_[order_[k]]);
    nodes_.push_back({box, begin, end, -1});
    if (end - begin <= kLeafSize) return self;
    int axis = 0;
    box.sizes().maxCoeff(&axis);
    const Index middle = (begin + end) / 2;
    std::nth_element(order_.begin() + begin, order_.begin() + middle, order_.begin() + end,
                     [&](Index a, Index b) {
                       const double p = boxes_[a].center()(axis), q = boxes_[b].center()(axis);
                       return p != q ? p < q : a < b;
                     });
    build(begin, middle);
    const Index second = build(middle, end);
    nodes_[self].second = second;
    return self;
  }

  template <class Visit>
  bool search(Index number, const Box& query, const Visit& visit) const {
    const Node& node = nodes_[number];
    if (!node.box.intersects(query)) return false;
    if (node.second >= 0) {
      return search(number + 1, query, visit) || search(node.second, query, visit);
    }
    for (Index k = node.begin; k < node.end; ++k) {
      if (boxes_[order_[k]].intersects(query) && visit(order_[k])) return true;
    }
    return false;
  }

  std::vector<Box> boxes_;
  std::vector<Index> order_;
  std::vector<Node> nodes_;
};

//! A model as a set of points, segments, and triangles, for exact tests. If a surface does not
//! intersect them, each connected part of the model is on one side, so one point per part decides.
template <int Dim>
class Enclosure {
 public:
  using Box = Eigen::AlignedBox<double, Dim>;

  //! \param points  Dim x P \param facets  corners may repeat; points without a facet also count
  Enclosure(const PointList<Dim>& points, const FacetList<Dim>& facets);

  bool meets(const Simplex<Dim>& facet) const;

  //! Whether the cage does not intersect the model and encloses all of it.
  bool is_strictly_inside(const Cage<Dim>& cage) const;

  //! One point of each connected part, in the order of the model's points.
  const PointList<Dim>& representatives() const { return representatives_; }

  const std::vector<Simplex<Dim>>& simplices() const { return simplices_; }
  const Box& box() const { return box_; }

  //! Distance from the model. \param limit  upper bound of the result
  double distance(const Vector<Dim>& point, double limit) const;
  //! With 8 times the model size as the limit.
  double distance(const Vector<Dim>& point) const;

 private:
  std::vector<Simplex<Dim>> simplices_;
  OverlapTree<Dim> tree_;
  PointList<Dim> representatives_;
  Box box_;
};

//! Distances between a surface (2D: lines) and a model.
struct Distances {
  double mean = 0, largest = 0;
};

//! At control points (the largest only), and at points evenly distributed on every facet.
template <int Dim>
Distances distances(const Cage<Dim>& cage, const Enclosure<Dim>& model);

//! Unit vectors to try in order; none is along an axis or diagonal. \param axis  the vector has a
//! positive component along this axis; -1: any
template <int Dim>
Vector<Dim> ray_direction(int attempt, int axis = -1);

//! Whether a segment from the point to infinity crosses the facets an odd number of times. False if
//! the point lies on a facet.
//! \param directions_axis  the segment points toward larger coordinates of this axis; -1: any
//! direction
template <int Dim>
bool has_odd_crossings(const Vector<Dim>& point, const std::vector<Simplex<Dim>>& facets,
                       int directions_axis = -1);

}  // namespace flbc
