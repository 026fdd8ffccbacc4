// SPDX-License-Identifier: BSD-3-Clause
#include "polytope/nearest_point_in_hull.h"

#include <algorithm>
#include <limits>

#include "linear/dense.h"

namespace flbc {
namespace {

// Wolfe's corral: affinely independent points around the origin with positive weights.
template <int Dim>
class Corral {
 public:
  explicit Corral(const PointList<Dim>& offsets) : offsets_(offsets) {}

  int size() const { return size_; }
  Index member(int k) const { return members_[k]; }
  double weight(int k) const { return weights_[k]; }
  bool contains(Index i) const {
    return std::find(members_.begin(), members_.begin() + size_, i) != members_.begin() + size_;
  }

  void add(Index i) {
    members_[size_] = i;
    weights_[size_] = size_ == 0 ? 1 : 0;
    ++size_;
  }

  // Moves the weights toward the point of the affine hull that is nearest to the origin; members
  // whose weights reach zero on the way are dropped, and the rest continues.
  void descend() {
    for (;;) {
      const Weights wanted = nearest_in_affine_hull();
      double step = 1;
      for (int k = 0; k < size_; ++k) {
        if (wanted[k] > 0) continue;
        step = std::min(step, weights_[k] / (weights_[k] - wanted[k]));
      }
      for (int k = 0; k < size_; ++k) weights_[k] += step * (wanted[k] - weights_[k]);
      if (!drop_unused(wanted)) return;
    }
  }

  // The combination of the members: the foot of the perpendicular from the origin on their affine
  // hull. Summing the members would lose the direction of a short vector to rounding.
  Vector<Dim> point() const {
    Vector<Dim> foot = offsets_.col(members_[0]);
    if (size_ == 1) return foot;
    const Edges basis = dense::orthonormal_basis(edges());
    for (int pass = 0; pass < 2; ++pass) {
      for (int k = 0; k + 1 < size_; ++k) foot -= basis.col(k).dot(foot) * basis.col(k);
    }
    return foot;
  }

 private:
  using Weights = std::array<double, Dim + 1>;
  using Edges = Eigen::Matrix<double, Dim, Eigen::Dynamic, 0, Dim, Dim>;

  Edges edges() const {
    Edges edges(Dim, size_ - 1);
    for (int k = 1; k < size_; ++k) {
      edges.col(k - 1) = offsets_.col(members_[k]) - offsets_.col(members_[0]);
    }
    return edges;
  }

  Weights nearest_in_affine_hull() const {
    Weights weights{1};
    if (size_ == 1) return weights;
    const Eigen::VectorXd rest = dense::least_squares(edges(), -offsets_.col(members_[0]));
    for (int k = 1; k < size_; ++k) weights[k] = rest[k - 1];
    weights[0] = 1 - rest.sum();
    return weights;
  }

  // The weight that limited the step is zero up to rounding.
  bool drop_unused(const Weights& wanted) {
    constexpr double kZero = 4 * std::numeric_limits<double>::epsilon();
    int kept = 0;
    for (int k = 0; k < size_; ++k) {
      if (wanted[k] <= 0 && weights_[k] <= kZero) continue;
      members_[kept] = members_[k];
      weights_[kept++] = weights_[k];
    }
    const bool dropped = kept < size_;
    size_ = kept;
    return dropped;
  }

  const PointList<Dim>& offsets_;
  int size_ = 0;
  std::array<Index, Dim + 1> members_{};
  Weights weights_{};
};

}  // namespace

template <int Dim>
HullPoint<Dim> nearest_point_in_hull(const PointList<Dim>& points, const Vector<Dim>& query) {
  const PointList<Dim> offsets = points.colwise() - query;
  const double reach = offsets.colwise().norm().maxCoeff();
  const double rounding = 4 * std::numeric_limits<double>::epsilon() * reach;
  Corral<Dim> corral(offsets);
  Eigen::Index next;
  offsets.colwise().squaredNorm().minCoeff(&next);
  corral.add(static_cast<Index>(next));
  // Every corral is optimal for its members and none repeats, so the loop terminates in exact
  // arithmetic. The limit handles rounding.
  for (Eigen::Index round = 0; round < 10 * (points.cols() + Dim); ++round) {
    const Vector<Dim> nearest = corral.point();
    const double distance = nearest.norm();
    if (distance <= rounding || corral.size() == Dim + 1) break;
    const double gain = nearest.dot(nearest) - (nearest.transpose() * offsets).minCoeff(&next);
    if (gain <= rounding * distance || corral.contains(static_cast<Index>(next))) break;
    corral.add(static_cast<Index>(next));
    corral.descend();
  }
  HullPoint<Dim> result;
  result.size = corral.size();
  double sum = 0;
  for (int k = 0; k < result.size; ++k) sum += corral.weight(k);
  result.point.setZero();
  for (int k = 0; k < result.size; ++k) {
    result.support[k] = corral.member(k);
    result.weights[k] = corral.weight(k) / sum;
    result.point += result.weights[k] * points.col(result.support[k]);
  }
  result.distance = (result.point - query).norm();
  return result;
}

template HullPoint<2> nearest_point_in_hull(const PointList<2>&, const Vector<2>&);
template HullPoint<3> nearest_point_in_hull(const PointList<3>&, const Vector<3>&);

}  // namespace flbc
