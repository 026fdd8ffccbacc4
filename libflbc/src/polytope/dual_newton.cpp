// SPDX-License-Identifier: BSD-3-Clause
#include "polytope/dual_newton.h"

#include <cmath>
#include <limits>
#include <utility>

#include "linear/dense.h"

namespace flbc {
namespace {

constexpr double kRounding = std::numeric_limits<double>::epsilon();
constexpr int kMaxSteps = 60;
constexpr int kMaxTrials = 60;
// Accuracy of the line search, relative to the initial slope.
constexpr double kSlopeLeft = 1e-3;
// A smaller delta would be lost in rounding errors of the normal equations.
constexpr double kLeastDeltaForHessian = 1e-13;

}  // namespace

template <int Dim>
bool DualNewton<Dim>::minimize(const Eigen::VectorXd& row, const Sums& sums, double delta) {
  mu_.setZero();
  active_.clear();
  bool full_step = false;
  for (int step = 0; step < kMaxSteps; ++step) {
    std::swap(active_, active_before_);
    evaluate(row, sums, delta);
    // On one piece of F a full step is exact.
    if (full_step && active_ == active_before_) return true;
    if (gradient_.norm() <= kRounding * (1 + mu_.norm())) return true;

    const Sums direction = newton_direction(delta);
    if (!direction.allFinite()) return false;
    const double length = step_length(direction, sums, delta);
    full_step = length == 1;
    mu_ += length * direction;
  }
  return false;
}

// Row, gradient and Hessian at mu.
template <int Dim>
void DualNewton<Dim>::evaluate(const Eigen::VectorXd& row, const Sums& sums, double delta) {
  row_ = row;
  row_.noalias() += basis_ * mu_;
  active_.clear();
  gradient_ = delta * mu_ - sums;
  hessian_.setZero();
  for (Index i = 0; i < static_cast<Index>(row_.size()); ++i) {
    if (!(row_[i] > 0)) continue;
    active_.push_back(i);
    const Sums q = basis_.row(i).transpose();
    gradient_ += row_[i] * q;
    hessian_ += q * q.transpose();
  }
}

template <int Dim>
typename DualNewton<Dim>::Sums DualNewton<Dim>::newton_direction(double delta) const {
  using Square = Eigen::Matrix<double, Dim + 1, Dim + 1>;
  if (delta >= kLeastDeltaForHessian) {
    return -dense::solve_symmetric<Dim + 1>(hessian_ + delta * Square::Identity(), gradient_);
  }
  Basis factors(active_.size() + Dim + 1, Dim + 1);
  factors << basis_(active_, Eigen::all), std::sqrt(delta) * Square::Identity();
  return -dense::solve_normal_equations(factors, gradient_);
}

// Step length where the derivative of F along the direction vanishes, at most 1. The derivative is
// piecewise linear and increasing; Newton's method finds its root in a few steps from a bracket.
template <int Dim>
double DualNewton<Dim>::step_length(const Sums& direction, const Sums& sums, double delta) {
  change_.noalias() = basis_ * direction;
  const double constant = delta * mu_.dot(direction) - sums.dot(direction);
  const double bound = kSlopeLeft * std::abs(gradient_.dot(direction));
  double low = 0, high = 1, t = 1;
  for (int trial = 0; trial < kMaxTrials; ++trial) {
    double curvature = delta * direction.squaredNorm();
    double slope = constant + t * curvature;
    for (Eigen::Index i = 0; i < row_.size(); ++i) {
      const double moved = row_[i] + t * change_[i];
      slope += moved > 0 ? moved * change_[i] : 0;
      curvature += moved > 0 ? change_[i] * change_[i] : 0;
    }
    if (std::abs(slope) <= bound || (t == 1 && slope < 0)) return t;
    (slope > 0 ? high : low) = t;
    t -= slope / curvature;
    if (!(t > low && t < high)) t = (low + high) / 2;
  }
  return t;
}

template class DualNewton<2>;
template class DualNewton<3>;

}  // namespace flbc
