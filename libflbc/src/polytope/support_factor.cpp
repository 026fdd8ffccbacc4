// SPDX-License-Identifier: BSD-3-Clause
#include "polytope/support_factor.h"

#include <algorithm>
#include <cmath>

#include "polytope/scaling.h"

namespace flbc {

template <int Dim>
bool SupportFactor<Dim>::compute(Metric metric, const PointList<Dim>& control_points,
                                 double inverse_scale, const std::vector<Index>& support) {
  support_ = support;
  stiffnesses_.clear();
  center_.setZero();
  for (const Index i : support) center_ += control_points.col(i);
  center_ /= static_cast<double>(support.size());
  rows_.resize(support.size());
  for (std::size_t k = 0; k < support.size(); ++k) {
    rows_[k] << 1, (control_points.col(support[k]) - center_) * inverse_scale;
  }
  lower_.clear();
  if (!metric.is_identity() && !factor_metric(metric)) {
    support_.clear();
    return false;
  }
  factor_gram();
  return true;
}

// Computes L, and L^-1 A in place of A. Explicit loops, because library calls are slower for so few
// control points.
template <int Dim>
bool SupportFactor<Dim>::factor_metric(Metric metric) {
  const std::size_t count = support_.size();
  lower_.resize(count * count);
  for (std::size_t j = 0; j < count; ++j) {
    double* const column = lower_.data() + j * count;
    for (std::size_t i = j; i < count; ++i) column[i] = metric(support_[i], support_[j]);
    for (std::size_t k = 0; k < j; ++k) {
      const double* const before = lower_.data() + k * count;
      const double factor = before[j];
      for (std::size_t i = j; i < count; ++i) column[i] -= factor * before[i];
      rows_[j] -= factor * rows_[k];
    }
    if (!(column[j] > 0)) return false;
    const double inverse = 1 / std::sqrt(column[j]);
    for (std::size_t i = j + 1; i < count; ++i) column[i] *= inverse;
    rows_[j] *= inverse;
    column[j] = inverse;
  }
  return true;
}

// G, and rows that are orthonormal as columns.
template <int Dim>
void SupportFactor<Dim>::factor_gram() {
  gram_.setZero();
  for (const Sums& row : rows_) gram_.noalias() += row * row.transpose();
  gram_.diagonal().array() += kRidge * gram_.trace();
  for (int i = 0; i <= Dim; ++i) {
    for (int j = 0; j <= i; ++j) {
      double value = gram_(i, j);
      for (int k = 0; k < j; ++k) value -= gram_(i, k) * gram_(j, k);
      gram_(i, j) = i == j ? 1 / std::sqrt(value) : value * gram_(j, j);
    }
  }
  for (Sums& row : rows_) orthonormalize(row);
}

template <int Dim>
void SupportFactor<Dim>::solve_lower(double* values) const {
  const std::size_t count = support_.size();
  for (std::size_t i = 0; i < count && !lower_.empty(); ++i) {
    const double* const column = lower_.data() + i * count;
    const double value = values[i] *= column[i];
    for (std::size_t k = i + 1; k < count; ++k) values[k] -= value * column[k];
  }
}

template <int Dim>
void SupportFactor<Dim>::solve_upper(double* values) const {
  const std::size_t count = support_.size();
  for (std::size_t i = lower_.empty() ? 0 : count; i-- > 0;) {
    const double* const column = lower_.data() + i * count;
    double value = values[i];
    for (std::size_t k = i + 1; k < count; ++k) value -= column[k] * values[k];
    values[i] = value * column[i];
  }
}

template <int Dim>
void SupportFactor<Dim>::orthonormalize(Sums& constraint) const {
  for (int i = 0; i <= Dim; ++i) {
    for (int j = 0; j < i; ++j) constraint[i] -= gram_(i, j) * constraint[j];
    constraint[i] *= gram_(i, i);
  }
}

template <int Dim>
void SupportFactor<Dim>::solve_multipliers(Sums& multipliers) const {
  for (int i = Dim; i >= 0; --i) {
    multipliers[i] *= gram_(i, i);
    for (int k = 0; k < i; ++k) multipliers[k] -= gram_(i, k) * multipliers[i];
  }
}

template <int Dim>
const std::vector<double>& SupportFactor<Dim>::stiffnesses() {
  if (!stiffnesses_.empty()) return stiffnesses_;
  const std::size_t count = support_.size();
  std::vector<double> unit(count);
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t end = lower_.empty() ? i + 1 : count;
    std::fill(unit.begin(), unit.end(), 0);
    unit[i] = 1;
    solve_lower(unit.data());
    double freedom = 0;
    Sums q = Sums::Zero();
    for (std::size_t k = i; k < end; ++k) {
      freedom += unit[k] * unit[k];
      q += unit[k] * rows_[k];
    }
    stiffnesses_.push_back(1 / std::max(freedom - q.squaredNorm(), kRidge * freedom));
  }
  return stiffnesses_;
}

template class SupportFactor<2>;
template class SupportFactor<3>;

}  // namespace flbc
