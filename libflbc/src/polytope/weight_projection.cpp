// SPDX-License-Identifier: BSD-3-Clause
#include "polytope/weight_projection.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "flbc/bounding_box.h"
#include "linear/dense.h"
#include "polytope/nearest_point_in_hull.h"
#include "polytope/scaling.h"

namespace flbc {
namespace {

// Smaller errors of sum and reproduction (relative to cage size) are rounding errors.
constexpr double kExact = 4e-14;
// A larger violation may improve in a few more steps.
constexpr double kPolished = 2e-15;
constexpr double kNewtonDelta = 1e-12;

}  // namespace

template <int Dim>
WeightProjection<Dim>::WeightProjection(const PointList<Dim>& control_points)
    : points_(control_points),
      scale_(scale_of<Dim>(control_points)),
      center_(control_points.rowwise().mean()) {
  const PointList<Dim> offsets = scaled_offsets<Dim>(points_, center_, scale_);
  axes_ = dense::principal_axes<Dim>(dense::moments<Dim>(offsets));
  const PointList<Dim> turned = axes_.transpose() * offsets;
  lengths_ = turned.rowwise().norm();
  // Coordinates along an axis without extent are rounding errors and must not be amplified.
  lengths_ = lengths_.cwiseMax(std::max(1e-12 * lengths_.maxCoeff(), 1e-100));
  basis_.resize(points_.cols(), Dim + 1);
  basis_.col(0).setConstant(1 / std::sqrt(static_cast<double>(points_.cols())));
  for (int k = 0; k < Dim; ++k) basis_.col(k + 1) = turned.row(k).transpose() / lengths_[k];
}

// b = Q^T w of every feasible w.
template <int Dim>
typename WeightProjection<Dim>::Sums WeightProjection<Dim>::sums_of(
    const Vector<Dim>& point) const {
  Sums sums;
  sums[0] = basis_(0, 0);
  sums.template tail<Dim>() =
      (axes_.transpose() * ((point - center_) / scale_)).cwiseQuotient(lengths_);
  return sums;
}

// Errors of sum and reproduction of a row with Q^T w = b + residual, relative to the size.
template <int Dim>
double WeightProjection<Dim>::violation(const Sums& residual) const {
  return std::max(std::abs(residual[0]) / basis_(0, 0),
                  residual.template tail<Dim>().cwiseProduct(lengths_).norm());
}

template <int Dim>
bool WeightProjection<Dim>::is_feasible(const Vector<Dim>& point,
                                        const Eigen::VectorXd& weights) const {
  return weights.minCoeff() >= 0 &&
         violation(basis_.transpose() * weights - sums_of(point)) <= kExact;
}

template <int Dim>
double WeightProjection<Dim>::project(const Vector<Dim>& point, Eigen::VectorXd& weights,
                                      Workspace& work) const {
  if (is_feasible(point, weights)) {
    weights = (weights.array() > 0).select(weights, 0);  // -0 becomes 0
    return 0;
  }
  work.row_ = weights;
  if (!newton_round(sums_of(point), kNewtonDelta, work)) {
    const auto nearest = nearest_point_in_hull(points_, point);
    if (nearest.distance > kBoundaryTolerance * scale_) return nearest.distance;
    work.row_ = weights;
    if (!many_rounds(sums_of(nearest.point), work)) {
      // Rounding hides the nearest weights, so any feasible ones are used.
      work.candidate_ = vertex_of(nearest, weights.size());
    }
  }
  weights = work.candidate_;
  return 0;
}

template <int Dim>
bool WeightProjection<Dim>::project(const Vector<Dim>& point, const std::vector<Index>& support,
                                    const Eigen::VectorXd& given, Eigen::VectorXd& weights) const {
  // Weights that already fulfill the constraints up to rounding need no other ones.
  weights.setZero(given.size());
  weights(support) = given(support);
  if (polish(sums_of(point), weights) && is_feasible(point, weights)) return true;
  const WeightProjection<Dim> on_support(points_(Eigen::all, support));
  Workspace work(on_support);
  Eigen::VectorXd few = given(support);
  if (on_support.project(point, few, work) > 0) return false;
  weights.setZero(given.size());
  weights(support) = few;
  return is_feasible(point, weights);
}

// Replaces the row by one with the same projection, nearer to it. \return true if done
template <int Dim>
bool WeightProjection<Dim>::newton_round(const Sums& sums, double delta, Workspace& work) const {
  // Scaled by its largest entry, so the row is at most 1.
  const double unit = std::max(1.0, work.row_.maxCoeff());
  work.scaled_ = work.row_ / unit;
  const bool reached = work.newton_.minimize(work.scaled_, sums / unit, delta);
  work.row_ = unit * work.newton_.row();
  work.candidate_ = work.row_.cwiseMax(0);
  // For small steps, rounding may hide the minimum; polishing decides.
  return (reached || delta < kNewtonDelta) && polish(sums, work.candidate_);
}

// One iteration is not enough for very large entries, or for nearly degenerate supports with large
// multipliers.
template <int Dim>
bool WeightProjection<Dim>::many_rounds(const Sums& sums, Workspace& work) const {
  constexpr int kRounds = 40;
  constexpr double kFirstDelta = 1e-8, kLastDelta = 1e-22;
  double delta = kFirstDelta;
  for (int round = 0; round < kRounds; ++round) {
    if (newton_round(sums, delta, work)) return true;
    delta = std::max(kLastDelta, 0.03 * delta);
  }
  return false;
}

// Applies the smallest change of the positive weights that makes sum and reproduction exact.
// Weights that become negative are set to zero, and the rest is corrected again.
template <int Dim>
bool WeightProjection<Dim>::polish(const Sums& sums, Eigen::VectorXd& weights) const {
  constexpr int kRounds = 20, kQuickRounds = 4;
  // Weights below this do not change any sum.
  constexpr double kZero = 4 * std::numeric_limits<double>::epsilon();
  // Larger errors need the projection.
  constexpr double kLargest = 1e-6;
  for (int round = 0; round < kRounds; ++round) {
    weights = (weights.array() > kZero).select(weights, 0);
    const Sums residual = basis_.transpose() * weights - sums;
    const double error = violation(residual);
    if (error <= kPolished) return true;
    if (error > kLargest) return false;
    correct(residual, round >= kQuickRounds, weights);
  }
  return violation(basis_.transpose() * weights - sums) <= kExact;
}

template <int Dim>
void WeightProjection<Dim>::correct(const Sums& residual, bool careful,
                                    Eigen::VectorXd& weights) const {
  const auto support = positive_entries(weights);
  const typename DualNewton<Dim>::Basis rows = basis_(support, Eigen::all);
  Eigen::VectorXd change;
  if (careful) {
    change = dense::least_squares(rows.transpose(), residual, 1e-13);
  } else {
    // A support in a facet of the hull does not span one direction, in which nothing moves.
    Eigen::Matrix<double, Dim + 1, Dim + 1> gram = dense::gram<Dim + 1>(rows, rows);
    gram.diagonal().array() += 1e-15 * gram.trace();
    change = rows * dense::solve_symmetric<Dim + 1>(gram, residual);
  }
  for (std::size_t k = 0; k < support.size(); ++k) {
    weights[support[k]] = std::max(0.0, weights[support[k]] - change[k]);
  }
}

template class WeightProjection<2>;
template class WeightProjection<3>;

}  // namespace flbc
