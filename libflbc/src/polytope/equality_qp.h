// SPDX-License-Identifier: BSD-3-Clause
// Equality-constrained quadratic program for the weights of one point.
#pragma once

#include <vector>

#include "flbc/types.h"
#include "polytope/support_factor.h"

namespace flbc {

//! Minimizes (w - t) . H (w - t) over the w with sum w = 1, sum w c = x and w = 0 outside a
//! support, for one point x and target t at a time. Not thread-safe, because it keeps its buffers
//! and the factors of recent supports, which neighboring points often share.
template <int Dim>
class EqualityQp {
 public:
  using Sums = typename SupportFactor<Dim>::Sums;

  //! \param metric  H, n x n
  //! \param control_points  Dim x n, kept by reference
  EqualityQp(Metric metric, const PointList<Dim>& control_points);

  //! Sets the current point.
  //! \return H t, n, to be filled by the caller for the control points of the supports
  Eigen::VectorXd& aim_at(const Vector<Dim>& point);

  const Metric& metric() const { return metric_; }

  //! H t, n.
  const Eigen::VectorXd& pull() const { return pull_; }

  //! (1, (c - x) / size): the contribution of a unit weight to the constraints, whose sum must be
  //! (1, 0, ..). The size is that of the control points.
  Sums constraint(Index control_point) const { return constraint(control_point, point_); }

  //! Free if the support is unchanged.
  //! \return false if rounding hides the minimum. The caller must check whether the constraints are
  //! met
  bool minimize(const std::vector<Index>& support);

  //! The minimum, in the order of the support; valid until the next minimization.
  const std::vector<double>& weights() const { return weights_; }

  //! (w - t) . H (w - t) - t . H t at the minimum.
  double cost() const { return cost_; }

  //! m such that H (w - t) = A m on the support, A the constraints as rows.
  const Sums& multipliers() const { return multipliers_; }

  //! Half the second derivative of the minimum cost with respect to the weight of a control point
  //! outside the support.
  double curvature(Index newcomer);

  //! Increase of the minimum cost if a weight is fixed at 0, divided by its square, in the order of
  //! the support.
  const std::vector<double>& removal_costs() { return factor_->stiffnesses(); }

 private:
  Sums constraint(Index control_point, const Vector<Dim>& center) const {
    Sums sums;
    sums[0] = 1;
    for (int d = 0; d < Dim; ++d) {
      sums[d + 1] = (control_points_(d, control_point) - center[d]) * inverse_scale_;
    }
    return sums;
  }
  SupportFactor<Dim>* factor_of(const std::vector<Index>& support);

  Metric metric_;
  const PointList<Dim>& control_points_;
  double inverse_scale_;
  Vector<Dim> point_;
  Eigen::VectorXd pull_;  // H t

  std::vector<SupportFactor<Dim>> recent_;  // at the place that their support determines
  SupportFactor<Dim>* factor_ = nullptr;    // of the current support
  bool minimized_ = false;                  // whether the following belongs to it
  std::vector<double> targets_;             // L^-1 H t
  std::vector<double> weights_;
  Sums multipliers_;
  double cost_ = 0;
  std::vector<double> column_;
};

}  // namespace flbc
