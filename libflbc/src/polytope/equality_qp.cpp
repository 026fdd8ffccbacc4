// SPDX-License-Identifier: BSD-3-Clause
#include "polytope/equality_qp.h"

#include <algorithm>
#include <cmath>

#include "polytope/scaling.h"

namespace flbc {
namespace {

// Keeps the multipliers finite for control points in a line or plane.
constexpr double kRidge = 1e-13;
// Smaller residuals of the constraints are rounding errors.
constexpr double kSmallResidual = 1e-14;

}  // namespace

template <int Dim>
EqualityQp<Dim>::EqualityQp(Metric metric, const PointList<Dim>& control_points)
    : metric_(metric),
      control_points_(control_points),
      scale_(scale_of<Dim>(control_points)),
      constraints_(Dim + 1, control_points.cols()),
      pull_(control_points.cols()) {
  constraints_.row(0).setOnes();
}

template <int Dim>
Eigen::VectorXd& EqualityQp<Dim>::aim_at(const Vector<Dim>& point) {
  constraints_.template bottomRows<Dim>() = scaled_offsets<Dim>(control_points_, point, scale_);
  minimized_ = false;
  return pull_;
}

// Computes L, and L^-1 A and L^-1 H t in place of A and H t. Explicit loops, because library calls
// are slower for so few control points.
template <int Dim>
bool EqualityQp<Dim>::factor_metric() {
  const std::size_t count = support_.size();
  factor_.resize(std::max(factor_.size(), count * count));
  for (std::size_t i = 0; i < count; ++i) {
    double* const row = factor_.data() + i * count;
    double diagonal = metric_(support_[i], support_[i]);
    for (std::size_t j = 0; j < i; ++j) {
      const double* const above = factor_.data() + j * count;
      double value = metric_(support_[j], support_[i]);
      for (std::size_t k = 0; k < j; ++k) value -= row[k] * above[k];
      value *= above[j];
      row[j] = value;
      diagonal -= value * value;
      rows_[i] -= value * rows_[j];
      targets_[i] -= value * targets_[j];
    }
    if (!(diagonal > 0)) return false;
    row[i] = 1 / std::sqrt(diagonal);
    rows_[i] *= row[i];
    targets_[i] *= row[i];
  }
  return true;
}

// G, and rows that are orthonormal as columns.
template <int Dim>
void EqualityQp<Dim>::factor_gram() {
  gram_.setZero();
  for (std::size_t i = 0; i < support_.size(); ++i) {
    gram_.noalias() += rows_[i] * rows_[i].transpose();
  }
  gram_.diagonal().array() += kRidge * gram_.trace();
  for (int i = 0; i <= Dim; ++i) {
    for (int j = 0; j <= i; ++j) {
      double value = gram_(i, j);
      for (int k = 0; k < j; ++k) value -= gram_(i, k) * gram_(j, k);
      gram_(i, j) = i == j ? 1 / std::sqrt(value) : value * gram_(j, j);
    }
  }
  for (std::size_t i = 0; i < support_.size(); ++i) orthonormalize(rows_[i]);
}

// G^-1 a.
template <int Dim>
void EqualityQp<Dim>::orthonormalize(Sums& constraint) const {
  for (int i = 0; i <= Dim; ++i) {
    for (int j = 0; j < i; ++j) constraint[i] -= gram_(i, j) * constraint[j];
    constraint[i] *= gram_(i, i);
  }
}

// L^T w = L^-1 H t + L^-1 A m, where A^T w = (1, 0, ..) determines m.
template <int Dim>
bool EqualityQp<Dim>::minimize(const std::vector<Index>& support) {
  if (minimized_ && support == support_) return true;
  minimized_ = false;
  support_ = support;
  const std::size_t count = support.size();
  rows_.resize(std::max(rows_.size(), count));
  targets_.resize(std::max(targets_.size(), count));
  for (std::size_t i = 0; i < count; ++i) {
    rows_[i] = constraints_.col(support[i]);
    targets_[i] = pull_[support[i]];
  }
  if (!metric_.is_identity() && !factor_metric()) return false;
  factor_gram();
  Sums sums = Sums::Unit(0);
  orthonormalize(sums);
  multipliers_.setZero();
  weights_.assign(targets_.begin(), targets_.begin() + static_cast<std::ptrdiff_t>(count));
  // Repeated, because thin supports lose digits.
  for (int pass = 0; pass < 3; ++pass) {
    Sums missing = sums;
    for (std::size_t i = 0; i < count; ++i) missing -= weights_[i] * rows_[i];
    if (pass > 0 && missing.squaredNorm() < kSmallResidual * kSmallResidual) break;
    multipliers_ += missing;
    for (std::size_t i = 0; i < count; ++i) weights_[i] += rows_[i].dot(missing);
  }
  cost_ = 0;
  for (std::size_t i = 0; i < count; ++i) cost_ += weights_[i] * (weights_[i] - 2 * targets_[i]);
  for (int i = Dim; i >= 0; --i) {
    multipliers_[i] *= gram_(i, i);
    for (int k = 0; k < i; ++k) multipliers_[k] -= gram_(i, k) * multipliers_[i];
  }
  for (std::size_t i = count; !metric_.is_identity() && i-- > 0;) {
    const double* const row = factor_.data() + i * count;
    weights_[i] *= row[i];
    for (std::size_t k = 0; k < i; ++k) weights_[k] -= row[k] * weights_[i];
  }
  return minimized_ = std::isfinite(cost_);
}

// The Schur complement of the newcomer in the system of weights and multipliers.
template <int Dim>
double EqualityQp<Dim>::curvature(Index newcomer) {
  Sums q = constraint(newcomer);
  orthonormalize(q);
  if (metric_.is_identity()) return 1 + q.squaredNorm();
  const double whole = metric_(newcomer, newcomer);
  double freedom = whole;
  const std::size_t count = support_.size();
  column_.resize(count);
  for (std::size_t i = 0; i < count; ++i) {  // L^-1 H e_newcomer
    const double* const row = factor_.data() + i * count;
    double value = metric_(support_[i], newcomer);
    for (std::size_t k = 0; k < i; ++k) value -= row[k] * column_[k];
    column_[i] = value * row[i];
    freedom -= column_[i] * column_[i];
    q -= column_[i] * rows_[i];
  }
  return std::max(freedom, kRidge * whole) + q.squaredNorm();
}

// 1 / Z_ii, with Z = H^-1 - H^-1 A (A^T H^-1 A)^-1 A^T H^-1.
template <int Dim>
void EqualityQp<Dim>::removal_costs(std::vector<double>& costs) {
  const std::size_t count = support_.size();
  costs.resize(count);
  column_.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    Sums q = rows_[i];
    double freedom = 1;
    if (!metric_.is_identity()) {
      q.setZero();
      freedom = 0;
      for (std::size_t j = i; j < count; ++j) {  // L^-1 e_i
        const double* const row = factor_.data() + j * count;
        double value = j == i ? 1 : 0;
        for (std::size_t k = i; k < j; ++k) value -= row[k] * column_[k];
        column_[j] = value * row[j];
        freedom += column_[j] * column_[j];
        q += column_[j] * rows_[j];
      }
    }
    costs[i] = 1 / std::max(freedom - q.squaredNorm(), kRidge * freedom);
  }
}

template class EqualityQp<2>;
template class EqualityQp<3>;

}  // namespace flbc
