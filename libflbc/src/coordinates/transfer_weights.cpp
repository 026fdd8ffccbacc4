// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/transfer_weights.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <string>
#include <vector>

#include "base/instantiate.h"
#include "base/messages.h"
#include "base/shape_checks.h"
#include "flbc/errors.h"
#include "flbc/non_negative.h"
#include "flbc/types.h"
#include "polytope/nearest_point_in_hull.h"

namespace flbc {
namespace {

// A binary tree of boxes round elements, halved at the median of their middles.
template <int Dim>
class BoxTree {
 public:
  // \param low, high  Dim x E, the corners of the elements' boxes
  BoxTree(PointList<Dim> low, PointList<Dim> high)
      : low_(std::move(low)), high_(std::move(high)), order_(low_.cols()) {
    std::iota(order_.begin(), order_.end(), 0);
    if (!order_.empty()) add_node(0, order_.size());
  }

  // \param distance_to  of an element from the point: distance_to(element) -> double
  // \return the nearest element, of equally near ones that with the least number; -1 for none
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
      if (found > distance || (found == distance && candidate > element)) return;
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

template <int Dim>
void check_input(const PointList<Dim>& control_points, const ModelElements<Dim>& from,
                 const WeightMatrix& weights) {
  check_size(weights, control_points.cols(), from.points.cols());
  if (from.corners.cols() == 0) throw InputError("the model has nothing to be near to");
  for (Eigen::Index e = 0; e < from.corners.cols(); ++e) {
    for (const Index corner : from.corners.col(e)) {
      if (corner >= 0 && corner < from.points.cols()) continue;
      throw InputError("element " + std::to_string(e) + " has a corner " + std::to_string(corner) +
                       ", but the model has " + std::to_string(from.points.cols()) + " vertices");
    }
  }
}

// Finds the place of a model that is nearest to a point.
template <int Dim>
class NearestPlace {
 public:
  explicit NearestPlace(const ModelElements<Dim>& model)
      : model_(model), tree_(extreme(false), extreme(true)) {}

  // \param place  its weights are for the element's corners \return the element
  Index operator()(const Vector<Dim>& point, HullPoint<Dim>& place) const {
    const Index element = tree_.nearest(
        point, [&](Index e) { return nearest_point_in_hull<Dim>(corners(e), point).distance; });
    place = nearest_point_in_hull<Dim>(corners(element), point);
    return element;
  }

 private:
  PointList<Dim> corners(Index element) const {
    PointList<Dim> corners(Dim, 3);
    for (int k = 0; k < 3; ++k) corners.col(k) = model_.points.col(model_.corners(k, element));
    return corners;
  }
  PointList<Dim> extreme(bool high) const {
    PointList<Dim> extremes(Dim, model_.corners.cols());
    for (Index e = 0; e < model_.corners.cols(); ++e) {
      if (high) {
        extremes.col(e) = corners(e).rowwise().maxCoeff();
      } else {
        extremes.col(e) = corners(e).rowwise().minCoeff();
      }
    }
    return extremes;
  }

  const ModelElements<Dim>& model_;
  BoxTree<Dim> tree_;
};

template <int Dim>
void refuse_unmatched(const PointList<Dim>& to, const Eigen::VectorXd& distances, double limit) {
  std::vector<Index> unmatched;
  for (Index p = 0; p < to.cols(); ++p) {
    if (!(distances[p] <= limit)) unmatched.push_back(p);
  }
  if (unmatched.empty()) return;
  Eigen::Index farthest = 0;
  distances.maxCoeff(&farthest);
  std::string numbers;
  constexpr std::size_t kNamed = 10;
  for (std::size_t k = 0; k < std::min(kNamed, unmatched.size()); ++k) {
    numbers += (k > 0 ? ", " : "") + std::to_string(unmatched[k]);
  }
  if (unmatched.size() > kNamed) numbers += " ...";
  throw InputError(std::to_string(unmatched.size()) + " of " + std::to_string(to.cols()) +
                   " vertices (" + numbers + ") are farther than " + format_number(limit) +
                   " from the model that has weights; the farthest is vertex " +
                   std::to_string(farthest) + " at " + format_point(to.col(farthest)) + ", by " +
                   format_number(distances[farthest]));
}

}  // namespace

template <int Dim>
WeightMatrix transfer_weights(const PointList<Dim>& control_points, const ModelElements<Dim>& from,
                              const WeightMatrix& weights, const PointList<Dim>& to, double limit,
                              Eigen::VectorXd* distances) {
  check_input(control_points, from, weights);
  const NearestPlace<Dim> nearest(from);
  const auto num_points = static_cast<Index>(to.cols());
  WeightMatrix result = WeightMatrix::Zero(weights.rows(), num_points);
  Eigen::VectorXd found(num_points);
#pragma omp parallel for schedule(dynamic, 64)
  for (Index p = 0; p < num_points; ++p) {
    HullPoint<Dim> place;
    const Index element = nearest(to.col(p), place);
    found[p] = place.distance;
    for (int k = 0; k < place.size; ++k) {
      result.col(p) += place.weights[k] * weights.col(from.corners(place.support[k], element));
    }
  }
  refuse_unmatched(to, found, limit);
  project_non_negative(control_points, to, result);
  if (distances != nullptr) *distances = std::move(found);
  return result;
}

FLBC_INSTANTIATE_FUNCTION(transfer_weights)

}  // namespace flbc
