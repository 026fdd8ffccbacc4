// SPDX-License-Identifier: BSD-3-Clause
#include "sparsify/equality_qp.h"

#include <algorithm>
#include <cmath>

namespace flbc {
namespace {

// Keeps the multipliers finite for control points in a line or plane.
constexpr double kRidge = 1e-13;

}  // namespace

template <int Dim>
FreeRow<Dim>::FreeRow(const Eigen::MatrixXd& metric, const PointList<Dim>& control_points,
                      double size)
    : metric_(metric), control_points_(control_points), size_(size), pull_(metric.rows()) {
}

template <int Dim>
Eigen::VectorXd& FreeRow<Dim>::aim_at(const Vector<Dim>& point) {
  point_ = point;
  return pull_;
}

template <int Dim>
typename FreeRow<Dim>::Sums FreeRow<Dim>::constraint(Index control_point) const {
  Sums sums;
  sums[0] = 1;
  sums.template tail<Dim>() = (control_points_.col(control_point) - point_) / size_;
  return sums;
}

// L and L^-1 [A, H t]. Written out, because for so few rows calls would take longer.
template <int Dim>
bool FreeRow<Dim>::factor(const std::vector<Index>& support) {
  const std::size_t count = support.size();
  factor_.resize(std::max(factor_.size(), count * count));
  sides_.resize(std::max(sides_.size(), count));
  for (std::size_t i = 0; i < count; ++i) {
    double* const row = factor_.data() + i * count;
    Sides& sides = sides_[i];
    sides << constraint(support[i]), pull_[support[i]];
    double diagonal = metric_(support[i], support[i]);
    for (std::size_t j = 0; j < i; ++j) {
      const double* const above = factor_.data() + j * count;
      double value = metric_(support[j], support[i]);
      for (std::size_t k = 0; k < j; ++k) value -= row[k] * above[k];
      value /= above[j];
      row[j] = value;
      diagonal -= value * value;
      sides -= value * sides_[j];
    }
    if (!(diagonal > 0)) return false;
    row[i] = std::sqrt(diagonal);
    sides /= row[i];
  }
  return true;
}

// L^T w = L^-1 H t + L^-1 A m, where A^T w = (1, 0, ..) says what m is.
template <int Dim>
bool FreeRow<Dim>::minimize(const std::vector<Index>& support) {
  if (!factor(support)) return false;
  const std::size_t count = support.size();
  Square gram = Square::Zero();
  Sums right = Sums::Unit(0);
  for (std::size_t i = 0; i < count; ++i) {
    const Sums a = sides_[i].template head<Dim + 1>();
    gram.noalias() += a * a.transpose();
    right -= sides_[i][Dim + 1] * a;
  }
  gram.diagonal().array() += kRidge * gram.trace();
  gram_.compute(gram);
  multipliers_ = gram_.solve(right);
  weights_.resize(count);
  // Twice, because thin supports cost digits.
  for (int pass = 0; pass < 2; ++pass) {
    Sums missing = Sums::Unit(0);
    for (std::size_t i = 0; i < count; ++i) {
      const Sums a = sides_[i].template head<Dim + 1>();
      weights_[i] = sides_[i][Dim + 1] + a.dot(multipliers_);
      missing -= weights_[i] * a;
    }
    if (pass == 0) multipliers_ += gram_.solve(missing);
  }
  cost_ = 0;
  for (std::size_t i = 0; i < count; ++i) {
    cost_ += weights_[i] * (weights_[i] - 2 * sides_[i][Dim + 1]);
  }
  for (std::size_t i = count; i-- > 0;) {
    const double* const row = factor_.data() + i * count;
    weights_[i] /= row[i];
    for (std::size_t k = 0; k < i; ++k) weights_[k] -= row[k] * weights_[i];
  }
  return std::isfinite(cost_);
}

template <int Dim>
Eigen::VectorXd FreeRow<Dim>::absorbed() const {
  const Vector<Dim> tilt = multipliers_.template tail<Dim>() / size_;
  Eigen::VectorXd sums = control_points_.transpose() * tilt;
  sums.array() += multipliers_[0] - tilt.dot(point_);
  return sums;
}

// 1 / Z_ii, with Z = H^-1 - H^-1 A (A^T H^-1 A)^-1 A^T H^-1.
template <int Dim>
void FreeRow<Dim>::removal_costs(std::vector<double>& costs) {
  const std::size_t count = weights_.size();
  costs.resize(count);
  column_.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    Sums q = Sums::Zero();
    double freedom = 0;
    for (std::size_t j = i; j < count; ++j) {  // L^-1 e_i
      const double* const row = factor_.data() + j * count;
      double value = j == i ? 1 : 0;
      for (std::size_t k = i; k < j; ++k) value -= row[k] * column_[k];
      column_[j] = value / row[j];
      freedom += column_[j] * column_[j];
      q += column_[j] * sides_[j].template head<Dim + 1>();
    }
    costs[i] = 1 / std::max(freedom - q.dot(gram_.solve(q)), kRidge * freedom);
  }
}

template class FreeRow<2>;
template class FreeRow<3>;

}  // namespace flbc
