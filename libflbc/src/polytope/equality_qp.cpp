// SPDX-License-Identifier: BSD-3-Clause
#include "polytope/equality_qp.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "polytope/scaling.h"

namespace flbc {
namespace {

// Smaller residuals of the constraints are rounding errors.
constexpr double kSmallResidual = 1e-14;
// Number of factors to keep: a power of two.
constexpr std::size_t kRecent = 256;

std::size_t place_of(const std::vector<Index>& support) {
  std::uint64_t hash = 0;
  for (const Index i : support)
    hash = (hash + static_cast<std::uint64_t>(i) + 1) * 0x9e3779b97f4a7c15;
  return static_cast<std::size_t>(hash >> 32) % kRecent;
}

}  // namespace

template <int Dim>
EqualityQp<Dim>::EqualityQp(Metric metric, const PointList<Dim>& control_points)
    : metric_(metric),
      control_points_(control_points),
      inverse_scale_(1 / scale_of<Dim>(control_points)),
      pull_(control_points.cols()),
      recent_(kRecent) {
}

template <int Dim>
Eigen::VectorXd& EqualityQp<Dim>::aim_at(const Vector<Dim>& point) {
  point_ = point;
  minimized_ = false;
  return pull_;
}

template <int Dim>
SupportFactor<Dim>* EqualityQp<Dim>::factor_of(const std::vector<Index>& support) {
  auto& factor = recent_[place_of(support)];
  const bool is_known = factor.support() == support ||
                        factor.compute(metric_, control_points_, inverse_scale_, support);
  return is_known ? &factor : nullptr;
}

// L^T w = L^-1 H t + L^-1 A m, where A^T w = (1, (x - center) / scale) determines m.
template <int Dim>
bool EqualityQp<Dim>::minimize(const std::vector<Index>& support) {
  if (minimized_ && support == factor_->support()) return true;
  minimized_ = false;
  factor_ = factor_of(support);
  if (factor_ == nullptr) return false;
  const std::size_t count = support.size();
  const auto& rows = factor_->rows();
  targets_.resize(count);
  for (std::size_t i = 0; i < count; ++i) targets_[i] = pull_[support[i]];
  factor_->solve_lower(targets_.data());
  const Vector<Dim> offset = (point_ - factor_->center()) * inverse_scale_;
  Sums sums;
  sums << 1, offset;
  factor_->orthonormalize(sums);
  multipliers_.setZero();
  weights_ = targets_;
  // Repeated, because thin supports lose digits.
  for (int pass = 0; pass < 3; ++pass) {
    Sums missing = sums;
    for (std::size_t i = 0; i < count; ++i) missing -= weights_[i] * rows[i];
    if (pass > 0 && missing.squaredNorm() < kSmallResidual * kSmallResidual) break;
    multipliers_ += missing;
    for (std::size_t i = 0; i < count; ++i) weights_[i] += rows[i].dot(missing);
  }
  cost_ = 0;
  for (std::size_t i = 0; i < count; ++i) cost_ += weights_[i] * (weights_[i] - 2 * targets_[i]);
  factor_->solve_multipliers(multipliers_);
  multipliers_[0] += multipliers_.template tail<Dim>().dot(offset);  // constraints around x
  factor_->solve_upper(weights_.data());
  return minimized_ = std::isfinite(cost_);
}

// The Schur complement of the newcomer in the system of weights and multipliers.
template <int Dim>
double EqualityQp<Dim>::curvature(Index newcomer) {
  Sums q = constraint(newcomer, factor_->center());
  factor_->orthonormalize(q);
  if (metric_.is_identity()) return 1 + q.squaredNorm();
  const auto& support = factor_->support();
  column_.resize(support.size());
  for (std::size_t i = 0; i < support.size(); ++i) column_[i] = metric_(support[i], newcomer);
  factor_->solve_lower(column_.data());  // L^-1 H e_newcomer
  const double whole = metric_(newcomer, newcomer);
  double freedom = whole;
  for (std::size_t i = 0; i < support.size(); ++i) {
    freedom -= column_[i] * column_[i];
    q -= column_[i] * factor_->rows()[i];
  }
  return std::max(freedom, kRidge * whole) + q.squaredNorm();
}

template class EqualityQp<2>;
template class EqualityQp<3>;

}  // namespace flbc
