// SPDX-License-Identifier: BSD-3-Clause
// Finds the nearest of many segments or triangles to a point.
#pragma once

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

#include "flbc/types.h"
#include "polytope/nearest_point_in_hull.h"

namespace flbc {

//! A binary tree of boxes around elements, split at the median of their centers.
template <int Dim>
class BoxTree {
 public:
  //! \param low, high  Dim x E, the corners of the boxes of the elements
  BoxTree(PointList<Dim> low, PointList<Dim> high)
      : low_(std::move(low)), high_(std::move(high)), order_(low_.cols()) {
    std::iota(order_.begin(), order_.end(), 0);
    if (!order_.empty()) add_node(0, order_.size());
  }

  //! \param distance_to  of an element from the point: distance_to(element) -> double
  //! \return the nearest element; ties go to the smallest index; -1 if there is none
  template <class DistanceTo>
  Index nearest(const Vector<Dim>& point, const DistanceTo& distance_to) const {
    Search<DistanceTo> search{*this, point, distance_to};
    if (!nodes_.empty()) search.visit(0);
    return search.element;
  }

 private:
  static constexpr std::size_t kLeaf = 8;

  struct Node {
    Vector<Dim> low, high;
    std::size_t begin, end;
    std::size_t right;  // the left child follows its parent; 0 for leaves
  };

  template <class DistanceTo>
  struct Search {
    const BoxTree& tree;
    const Vector<Dim>& point;
    const DistanceTo& distance_to;
    Index element = -1;
    double distance = std::numeric_limits<double>::infinity();

    double distance_to_box(std::size_t number) const {
      const auto& node = tree.nodes_[number];
      return (point.cwiseMax(node.low).cwiseMin(node.high) - point).norm();
    }

    void visit(std::size_t number) {
      const auto& node = tree.nodes_[number];
      if (node.right == 0) {
        for (std::size_t k = node.begin; k < node.end; ++k) consider(tree.order_[k]);
        return;
      }
      std::size_t near = number + 1, far = node.right;
      double to_near = distance_to_box(near), to_far = distance_to_box(far);
      if (to_far < to_near) {
        std::swap(near, far);
        std::swap(to_near, to_far);
      }
      if (to_near <= distance) visit(near);
      if (to_far <= distance) visit(far);
    }

    void consider(Index candidate) {
      const double found = distance_to(candidate);
      const bool is_nearer = found < distance || (found == distance && candidate < element);
      // A distance that overflows is infinite.
      if (element >= 0 && !is_nearer) return;
      distance = found;
      element = candidate;
    }
  };

  // \return its number
  std::size_t add_node(std::size_t begin, std::size_t end) {
    const std::size_t number = nodes_.size();
    Node node{low_.col(order_[begin]), high_.col(order_[begin]), begin, end, 0};
    for (std::size_t k = begin + 1; k < end; ++k) {
      node.low = node.low.cwiseMin(low_.col(order_[k]));
      node.high = node.high.cwiseMax(high_.col(order_[k]));
    }
    nodes_.push_back(node);
    if (end - begin <= kLeaf) return number;
    Eigen::Index axis = 0;
    (node.high - node.low).maxCoeff(&axis);
    const std::size_t middle = (begin + end) / 2;
    const auto at = [&](std::size_t k) { return order_.begin() + static_cast<std::ptrdiff_t>(k); };
    std::nth_element(at(begin), at(middle), at(end), [&](Index a, Index b) {
      const double middle_a = low_(axis, a) + high_(axis, a);
      const double middle_b = low_(axis, b) + high_(axis, b);
      return middle_a != middle_b ? middle_a < middle_b : a < b;
    });
    add_node(begin, middle);
    const std::size_t right = add_node(middle, end);
    nodes_[number].right = right;
    return number;
  }

  PointList<Dim> low_, high_;
  std::vector<Index> order_;
  std::vector<Node> nodes_;
};

//! Finds the place on simplices of K corners that is nearest to a point.
template <int Dim, int K>
class NearestSimplex {
 public:
  //! \param points  Dim x P \param corners  K x E; both are kept by reference
  NearestSimplex(const PointList<Dim>& points, const FacetList<K>& corners)
      : points_(points), corners_(corners), tree_(extreme(false), extreme(true)) {}

  //! \param place  its weights refer to the corners of the simplex
  //! \return the simplex; ties go to the smallest index
  Index operator()(const Vector<Dim>& point, HullPoint<Dim>& place) const {
    const Index simplex = tree_.nearest(
        point, [&](Index e) { return nearest_point_in_hull<Dim>(corners_of(e), point).distance; });
    place = nearest_point_in_hull<Dim>(corners_of(simplex), point);
    return simplex;
  }

 private:
  PointList<Dim> corners_of(Index simplex) const {
    return points_(Eigen::all, corners_.col(simplex));
  }
  PointList<Dim> extreme(bool high) const {
    PointList<Dim> extremes(Dim, corners_.cols());
    for (Index e = 0; e < corners_.cols(); ++e) {
      if (high) {
        extremes.col(e) = corners_of(e).rowwise().maxCoeff();
      } else {
        extremes.col(e) = corners_of(e).rowwise().minCoeff();
      }
    }
    return extremes;
  }

  const PointList<Dim>& points_;
  const FacetList<K>& corners_;
  BoxTree<Dim> tree_;
};

}  // namespace flbc
